#include "pbs/exterior.h"

#include <algorithm>

namespace nacre {

void offer_exterior_index(Recorder& recorder) {
  recorder.input(exterior_index_channel, Scalar::f32);
}

Float exterior_index(Recorder& recorder) {
  const bool is_offered = std::ranges::find(recorder.program().inputs, exterior_index_channel,
                                            &Channel::name) != recorder.program().inputs.end();
  if (!is_offered) return 1.0f;
  return clamp(Float(recorder.input(exterior_index_channel, Scalar::f32)), 0.02f, 50.0f);
}

}  // namespace nacre
