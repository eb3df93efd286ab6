#include "pbs/cosine_lobe.h"

#include "pbs/sampling.h"

namespace nacre {

Float3 CosineLobe::axis(const View& view) const {
  const Float3 n = facing(normal_, view.wo);
  return hemisphere_ == Hemisphere::viewer ? n : -n;
}

LobeSample CosineLobe::sample(const View& view, Float3 u) const {
  const Float3 wi = make_frame(axis(view)).to_world(sample_cosine(u.x, u.y));
  return {.wi = wi, .valid = is_unit(wi)};
}

LobeValue LambertLobe::evaluate(const View& view, Float3 wi) const {
  const Float pdf = saturate(dot(axis(view), wi)) * one_over_pi;
  return {.f = color_ * Float3(pdf), .pdf = pdf};
}

}  // namespace nacre
