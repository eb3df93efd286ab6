#include "pbs/vdf.h"

#include <limits>

namespace nacre {

namespace {

Float total(Color3 c) { return c.x + c.y + c.z; }

}  // namespace

VdfPtr as_vdf(const ClosurePtr& closure) { return std::dynamic_pointer_cast<const Vdf>(closure); }

Color3 finite_coefficients(Color3 coefficients) {
  const Color3 positive = max(coefficients, Color3(0.0f));
  return min(positive, Color3(std::numeric_limits<float>::max()));
}

VdfPtr sum(const VdfPtr& a, const VdfPtr& b) {
  if (a == nullptr) return b;
  if (b == nullptr) return a;
  auto both = std::make_shared<Vdf>();
  both->absorption = a->absorption + b->absorption;
  both->scattering = a->scattering + b->scattering;
  const Float share = total(b->scattering) / total(both->scattering);
  // Neither scatters, or both without bound: any cosine does.
  const Float weight = select((share >= 0.0f) & (share <= 1.0f), share, 0.0f);
  both->anisotropy = fma(weight, b->anisotropy - a->anisotropy, a->anisotropy);
  return both;
}

VdfPtr scaled(const VdfPtr& vdf, Color3 factor) {
  if (vdf == nullptr) return nullptr;
  auto result = std::make_shared<Vdf>(*vdf);
  result->absorption = vdf->absorption * factor;
  result->scattering = vdf->scattering * factor;
  return result;
}

}  // namespace nacre
