#include "pbs/exterior.h"

namespace nacre {

void offer_exterior_index(Recorder& recorder) {
  recorder.input(exterior_index_channel, Scalar::f32);
}

Float exterior_index(Recorder& recorder) {
  if (!recorder.has_leaf(exterior_index_channel)) return 1.0f;
  return clamp(Float(recorder.input(exterior_index_channel, Scalar::f32)), 0.02f, 50.0f);
}

}  // namespace nacre
