#include "pbs/cosine_lobe.h"

#include "pbs/sampling.h"

namespace nacre {

Float3 CosineLobe::axis(const View& view) const {
  const Float3 n = facing(normal_, view.wo);
  return hemisphere_ == Hemisphere::viewer ? n : -n;
}

LobeSample CosineLobe::sample(const View& view, Float3 u) const {
  Frame frame = facing_frame(normal_, view.wo);
  if (hemisphere_ == Hemisphere::other) frame.z = -frame.z;
  const Float3 wi = frame.to_world(sample_cosine(u.x, u.y));
  return {.wi = wi, .valid = true};
}

LobeValue CosineLobe::evaluate(const View& view, Float3 wi) const {
  const Float pdf = saturate(dot(wi, axis(view))) * one_over_pi;
  return {.f = scattered(view, wi) * Color3(pdf), .pdf = pdf};
}

}  // namespace nacre
