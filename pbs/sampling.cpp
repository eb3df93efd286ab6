#include "pbs/sampling.h"

namespace nacre {

Float2 sample_disk(Float u, Float v) {
  const Float radius = sqrt(u);
  const Float phi = 2 * pi * v;
  return {radius * cos(phi), radius * sin(phi)};
}

Float3 sample_cosine(Float u, Float v) {
  const Float2 p = sample_disk(u, v);
  return {p.x, p.y, safe_sqrt(1.0f - u)};
}

}  // namespace nacre
