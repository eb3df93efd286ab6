#include "pbs/transport.h"

#include "pbs/facets.h"
#include "runtime/node/geometry.h"

namespace nacre {

namespace {

Float of_radiance(const Lobe& lobe, const View& view, Float3 ns, Float3 wi) {
  const Float* index = lobe.interior_index();
  if (index == nullptr || view.thin_walled.is_constant(true)) return 1.0f;
  const Bool below = dot(ns, view.wo) < 0.0f;
  const Bool is_bent = ((dot(ns, wi) < 0.0f) ^ below) & !(view.thin_walled | goes_straight(*index));
  const Float eta = relative_index(*index, below);
  return select(is_bent, 1.0f / (eta * eta), 1.0f);
}

Float of_importance(const View& view, Float3 ns, Float3 wi) {
  const Float3 ng = geometric_normal(*view.recorder);
  const Float above = abs(dot(view.wo, ns)) * abs(dot(wi, ng));
  const Float below = abs(dot(view.wo, ng)) * abs(dot(wi, ns));
  // One and the same where the normals are: no rounding.
  // Bounded for a wi of any bits, which has no light that NaN could be made of.
  return select(above == below, 1.0f, min(max(above / max(below, 1e-6f), 0.0f), 1e6f));
}

}  // namespace

Float transport_factor(const Lobe& lobe, const View& view, Float3 wi) {
  if (lobe.is_of_fibre()) return 1.0f;
  const Bool is_importance = Int(view.recorder->input("transport", Scalar::i32)) != Int(0);
  const Float3 ns = lobe.normal(view);
  return select(is_importance, of_importance(view, ns, wi), of_radiance(lobe, view, ns, wi));
}

}  // namespace nacre
