#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// What is known of a value: every number that it may be is in [low, high], infinities too, beside
/// NaN if `nan`.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool nan = true;
  bool minus_zero = true;  ///< If 0 is one of them, so may be -0.

  /// Finite numbers alone.
  bool is_bounded() const;
  bool operator==(const Range&) const = default;
};

/// Of the scalar product of two vectors that a Program reads, each by the name of its channels: "N"
/// and "wo" are N.x * wo.x + N.y * wo.y + N.z * wo.z, however that is rounded.
struct DotRange {
  std::string a, b;
  Range range;
  bool operator==(const DotRange&) const = default;
};

/// How engines round the operations of a Program.
enum class Arithmetic : std::uint8_t {
  unknown,      ///< By some units in the last place.
  as_written,   ///< Each to the nearest float, as op.h says.
  reassociated  ///< As LLVM likes, whose sums are of other parts: `fast`.
};

/// What is known of the numbers that a Program reads. Lists are as long as the Program's, or empty:
/// then nothing is known of those.
struct Known {
  std::vector<Range> inputs;      ///< Of Program::inputs, in order.
  std::vector<Range> parameters;  ///< Of Program::parameters.
  std::vector<DotRange> dots;
  Arithmetic arithmetic = Arithmetic::unknown;
  /// Operations of loops' rounds, calls and parts of ranges that are gone through, each of them
  /// once. Fractal noise of sixteen octaves takes less.
  std::size_t effort = 100'000;
};

/// Of each value of the entry, in order; of what is no f32 nothing is known. Conservative, by
/// interval arithmetic of the operations as op.h says them, with room for the rounding of floats;
/// inputs, parameters, texels, carries and results of calls may be anything.
std::vector<Range> ranges_of(const Program& program);

/// The same where so much is known of each of Program::inputs. Then i32 values have ranges, too;
/// functions and the rounds of loops are followed, and what is computed of one number alone is
/// looked at part by part of its range.
/// @{
std::vector<Range> ranges_of(const Program& program, const Known& known);
std::vector<Range> ranges_of(const Program& program, std::span<const Range> inputs);
/// @}

/// Of each of Program::outputs, where so much is known of each of Program::inputs.
/// @{
std::vector<Range> output_ranges(const Program& program, const Known& known);
std::vector<Range> output_ranges(const Program& program, std::span<const Range> inputs);
/// @}

}  // namespace nacre
