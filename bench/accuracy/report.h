#pragma once

#include <string>
#include <vector>

#include "bench/accuracy/math_function.h"
#include "bench/accuracy/sweep.h"

namespace nacre {

/// What was measured for one function.
struct MathReport {
  const MathFunction* function = nullptr;
  std::array<OperationCount, accuracy_modes.size()> operations;
  SweepResult result;
};

/// A table with a row for each function and mode, and for functions with a
/// near range one more.
std::string to_markdown(const std::vector<MathReport>& reports);

/// The same as JSON, arguments of the largest errors as bits in hexadecimal.
std::string to_json(const std::vector<MathReport>& reports, const SweepOptions& options,
                    const std::string& engine);

}  // namespace nacre
