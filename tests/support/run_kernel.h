#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "runtime/kernel.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/reference/reference.h"
#include "runtime/value/vector.h"

namespace nacre {

/// Arrays by channel name. As input an array of one value stands for as many as
/// needed; channels that a kernel does not read are passed over, channels that
/// it reads and that are not there are 0.
using Columns = std::map<std::string, std::vector<float>>;
using DoubleColumns = std::map<std::string, std::vector<double>>;

/// Runs a kernel on arrays, its parameters as in the document. Integer outputs
/// come as numbers. Run the reference engine's kernels with run_double to see
/// what it computes before it is rounded.
Columns run(const Kernel& kernel, const Columns& inputs);
DoubleColumns run_double(const ReferenceKernel& kernel, const Columns& inputs);

/// Records, slices and runs in one go, by the reference engine:
///
///   const auto out = evaluate({{"x", {0.f, 1.f}}}, [](Recorder& r) {
///     return std::vector<SliceOutput>{{"y", sqrt(input(r, "x")).ref()}};
///   });
///   out.at("y")[1]
template <class F>
DoubleColumns evaluate(const Columns& inputs, F&& body) {
  Recorder recorder;
  const std::vector<SliceOutput> outputs = body(recorder);
  return run_double(*make_reference(slice(recorder.program(), "test", outputs)), inputs);
}

inline Float input(Recorder& recorder, std::string_view name) {
  return Float(recorder.input(name, Scalar::f32));
}

}  // namespace nacre
