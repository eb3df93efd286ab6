#include "nodes/adjustment/hsv.h"

namespace nacre {

namespace {

/// Foley and van Dam's hexcone without its six cases: every channel is v (1 - s)
/// plus v s times a trapezoid of the hue. Unlike the cases it has no seam where
/// h - floor(h) rounds to 1.
Float3 hsv_to_rgb(Float3 hsv) {
  const Float hue = 6.0f * fract(hsv.x);
  const Float s = max(hsv.y, 0.0f);
  const auto channel = [&](Float trapezoid) {
    return hsv.z * fma(s, saturate(trapezoid) - 1.0f, 1.0f);
  };
  return {channel(abs(hue - 3.0f) - 1.0f), channel(2.0f - abs(hue - 2.0f)),
          channel(2.0f - abs(hue - 4.0f))};
}

}  // namespace

/// Hue (one turn is 1, wraps), saturation and value to red, green and blue; alpha
/// passes. MaterialX 1.39 Standard Nodes, "hsvtorgb". A saturation below 0 counts
/// as 0, as in Open Shading Language; one above 1 is not limited. NaN and infinite
/// hues give v (1 - s). A NaN saturation counts as 0.
void record_hsvtorgb(NodeCall& call) { record_colour(call, hsv_to_rgb); }

}  // namespace nacre
