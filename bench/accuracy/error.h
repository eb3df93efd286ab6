#pragma once

#include <cstdint>
#include <string>

namespace nacre {

/// Arguments of the largest error so far, as bits.
struct Largest {
  double error = 0.0;
  std::uint32_t x = 0;
  std::uint32_t y = 0;

  void add(double candidate, std::uint32_t at_x, std::uint32_t at_y) {
    if (!(candidate > error)) return;
    *this = {candidate, at_x, at_y};
  }
  void add(const Largest& other) { add(other.error, other.x, other.y); }
};

/// Errors of a function against its true values, the largest of each kind.
class ErrorStatistics {
 public:
  /// `got` is the result for the arguments of bits x and y, `truth` the value in
  /// double: within 2^-52 of the exact one, which ulps of float do not notice.
  void add(float got, double truth, std::uint32_t x, std::uint32_t y = 0);
  void merge(const ErrorStatistics& other);

  Largest ulp;
  Largest relative;  ///< Where truth is in the normal range.
  Largest absolute;  ///< Where truth and result are finite.
  std::uint64_t count = 0;
  /// NaN where there should be none, or none where there should, or an infinity
  /// of the wrong sign.
  std::uint64_t wrong = 0;
  std::uint32_t wrong_x = 0;
  std::uint32_t wrong_y = 0;
};

/// |got - truth| in units of the last place of truth, that of 2^-126 below it.
/// Infinity counts as 2^128, and zero as every value that is flushed to it.
double ulp_error(float got, double truth);

}  // namespace nacre
