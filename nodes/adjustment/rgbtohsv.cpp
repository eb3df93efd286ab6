#include "nodes/adjustment/hsv.h"

namespace nacre {

namespace {

/// Foley and van Dam, hexcone.
Float3 rgb_to_hsv(Float3 c) {
  const Float low = min(c.x, min(c.y, c.z));
  const Float high = max(c.x, max(c.y, c.z));
  const Float chroma = high - low;
  const Bool coloured = (high > 0.0f) & (chroma > 0.0f);
  const Float sextant =
      select(c.x >= high, (c.y - c.z) / chroma,
             select(c.y >= high, 2.0f + (c.z - c.x) / chroma, 4.0f + (c.x - c.y) / chroma));
  const Float turn = sextant * (1.0f / 6.0f);
  const Float hue = select(turn < 0.0f, turn + 1.0f, turn);
  return {select(coloured, hue, 0.0f), select(coloured, chroma / high, 0.0f), high};
}

}  // namespace

/// Red, green and blue to hue (one turn is 1), saturation and value; alpha passes.
/// MaterialX 1.39 Standard Nodes, "rgbtohsv". Hue and saturation are 0 for greys
/// and where no channel is positive. Not limited to [0, 1]. Infinite channels give
/// a saturation of NaN; NaN gives no defined hue.
void record_rgbtohsv(NodeCall& call) { record_colour(call, rgb_to_hsv); }

}  // namespace nacre
