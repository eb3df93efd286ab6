#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "bench/accuracy/error.h"
#include "bench/accuracy/math_function.h"
#include "runtime/kernel.h"

namespace nacre {

inline constexpr std::array accuracy_modes{Accuracy::precise, Accuracy::standard, Accuracy::fast};

struct SweepOptions {
  std::uint32_t stride = 1;    ///< Every how many floats; 1: all.
  std::uint64_t pairs = 1000;  ///< Of functions of two arguments, beside those of edge values.
  int threads = 1;
};

/// One mode's errors: over all arguments, and over those up to MathFunction::near.
struct ModeErrors {
  ErrorStatistics all;
  ErrorStatistics near;
};

struct SweepResult {
  std::array<ModeErrors, accuracy_modes.size()> modes;  ///< In the order of accuracy_modes.
  double seconds = 0.0;
};

/// Runs the kernels, one a mode, over the same arguments, so that the truth is
/// computed once. `progress` gets the part done, from any thread.
SweepResult sweep(const MathFunction& function,
                  const std::vector<std::shared_ptr<const Kernel>>& kernels,
                  const SweepOptions& options, const std::function<void(double)>& progress);

}  // namespace nacre
