#include "runtime/node/drawn_texels.h"

namespace nacre {

void offer_drawn_texels(Recorder& recorder) { recorder.input(drawn_texels_channel, Scalar::f32); }

std::optional<Float> drawn_texels(Recorder& recorder) {
  if (!recorder.has_leaf(drawn_texels_channel)) return std::nullopt;
  return min(Float(recorder.input(drawn_texels_channel, Scalar::f32)), 0x1.fffffep-1f);
}

}  // namespace nacre
