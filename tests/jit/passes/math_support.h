#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "jit/passes/expand_math.h"
#include "runtime/interpreter/interpreter.h"
#include "tests/support/run_kernel.h"

namespace nacre {

inline constexpr std::array modes{Accuracy::precise, Accuracy::standard, Accuracy::fast};
inline constexpr std::array univariate{Op::acos, Op::asin, Op::cos, Op::exp, Op::exp2,
                                       Op::log,  Op::log2, Op::sin, Op::tan};

/// "out" = op(x) or op(x, y), as recorded.
inline Program program_of(Op op) {
  Recorder recorder;
  std::vector<Ref> operands{recorder.input("x", Scalar::f32)};
  if (info(op).operands.size() == 2) operands.push_back(recorder.input("y", Scalar::f32));
  const std::vector<SliceOutput> outputs{{"out", recorder.emit(op, operands)}};
  return slice(recorder.program(), "math", outputs);
}

/// The interpreter on the expanded program.
inline std::vector<float> expanded(Op op, Accuracy mode, const Columns& inputs) {
  return run(*make_interpreter(expand_math(program_of(op), mode)), inputs).at("out");
}

/// The reference engine: the C library in double.
inline std::vector<double> truth(Op op, const Columns& inputs) {
  return run_double(*make_reference(program_of(op)), inputs).at("out");
}

/// |got - want| in units of want's last place, or of that of 2^-126; infinity
/// stands for 2^128 and a zero for any value that flushes to it. Infinite where
/// one is NaN.
inline double ulps(float got, double want) {
  if (std::isnan(got) || std::isnan(want)) {
    return std::isnan(got) && std::isnan(want) ? 0.0 : std::numeric_limits<double>::infinity();
  }
  const auto bounded = [](double x) { return std::fmin(std::fmax(x, -0x1p+128), 0x1p+128); };
  const double a = bounded(static_cast<double>(got));
  const double b = bounded(want);
  const double size = std::fmin(std::fmax(std::fabs(b), 0x1p-126), 0x1p+127);
  const double unit = std::ldexp(1.0, std::ilogb(size) - 23);
  if (a == 0.0) return std::fmax(0.0, std::fabs(b) - 0x1p-126) / unit;
  return std::fabs(a - b) / unit;
}

/// Every stride-th float, NaN and infinities among them.
inline std::vector<float> floats(std::uint32_t stride) {
  std::vector<float> list;
  for (std::uint64_t bits = 0; bits < (std::uint64_t{1} << 32); bits += stride) {
    list.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  }
  return list;
}

/// `count` values from low to high, evenly.
inline std::vector<float> grid(float low, float high, int count) {
  std::vector<float> list;
  for (int i = 0; i < count; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(count - 1);
    list.push_back(std::fma(t, high, (1.0f - t) * low));
  }
  return list;
}

inline std::string describe(Op op, Accuracy mode) {
  return std::string(info(op).name) + ", " + std::string(accuracy_name(mode));
}

}  // namespace nacre
