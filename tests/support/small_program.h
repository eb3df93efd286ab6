#pragma once

#include <vector>

#include "runtime/kernel.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/value/value.h"

namespace nacre {

/// x * slope + number, where `slope` is a parameter and `number` a literal: a
/// small Program, different for each number.
inline Program small_program(float number) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const Float slope(recorder.parameter("slope", Scalar::f32, 0x40000000u));
  const std::vector<SliceOutput> outputs{{"out", (x * slope + Float(number)).ref()}};
  return slice(recorder.program(), "small", outputs);
}

/// What a kernel of small_program() gives for x, with slope 2.
inline float run_small(const Kernel& kernel, float x) {
  const std::uint32_t slope = 0x40000000u;
  float result = 0;
  const void* inputs[]{&x};
  void* outputs[]{&result};
  kernel.run({.inputs = inputs, .outputs = outputs, .parameters = &slope, .count = 1});
  return result;
}

}  // namespace nacre
