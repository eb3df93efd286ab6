#pragma once

#include <limits>
#include <span>
#include <string>

#include "runtime/program/program.h"

namespace nacre {

/// A transcendental operation and what it should give.
struct MathFunction {
  const char* name;
  Op op;
  int arguments;
  double (*truth)(double x, double y);
  /// Arguments up to here also get figures of their own.
  float near = std::numeric_limits<float>::infinity();
};

std::span<const MathFunction> math_functions();

/// Inputs "x" (and "y"), output "out"; the operation as it was recorded.
Program program_of(const MathFunction& function);

/// How many operations a point costs; constants, inputs and stores are free.
struct OperationCount {
  int always = 0;
  int rare = 0;  ///< Those in regions that most batches skip, and what they call.
};
OperationCount count_operations(const Program& program);

}  // namespace nacre
