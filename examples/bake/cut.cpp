#include "examples/bake/cut.h"

#include <cmath>

namespace nacre::host {

Cut cut_of(const std::vector<float>& plane, const ChannelStatistics& known, Span held,
           bool is_half) {
  constexpr float rounding = 1e-5f;
  held = {held.least - rounding, held.most + rounding};
  const bool is_finite = known.finite == plane.size();
  if (is_finite && known.least >= held.least && known.most <= held.most) {
    return {0, known.least, known.most};
  }
  Cut cut;
  for (const float value : plane) {
    if (is_half && !std::isfinite(value)) continue;
    cut.count += value >= held.least && value <= held.most ? 0 : 1;
    cut.least = std::min(cut.least, value);
    cut.most = std::max(cut.most, value);
  }
  return cut;
}

}  // namespace nacre::host
