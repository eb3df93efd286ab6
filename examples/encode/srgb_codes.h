#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace nacre::host {

/// The codes of IEC 61966-2-1 for linear values, correctly rounded: the code c of x is
/// floor(largest * f(x) + 1/2), f in double precision and x clamped to [0, 1]; NaN is 0.
///
/// A table has the least float of every code. Another one says, for the upper bits of a
/// float, which code is the first of those that begin so, and where the next one begins: of
/// bytes that decides, of words some steps may follow.
class SrgbCodes {
 public:
  /// `largest` is 255 or 65535; the tables are made with the first one asked for.
  static const SrgbCodes& with(unsigned largest);

  unsigned operator()(float linear) const {
    const float positive = linear > least_[1] ? linear : least_[1];  // Of NaN and less.
    const float clamped = positive < 1.0f ? positive : 1.0f;
    const Start& start = starts_[(std::bit_cast<std::uint32_t>(clamped) >> shift_) - begin_];
    unsigned code = start.code + (clamped >= start.next ? 1u : 0u);
    if (has_steps_) {
      while (clamped >= least_[code + 1]) ++code;
    }
    return linear >= least_[1] ? code : 0;
  }

 private:
  /// Of floats with the same upper bits.
  struct Start {
    float next;  ///< The least float of the code after
    unsigned code;
  };

  explicit SrgbCodes(unsigned largest);

  int shift_;       ///< Lower bits of a float that the table of starts leaves out.
  bool has_steps_;  ///< Whether there are more than two codes in an entry of it.
  std::uint32_t begin_ = 0;
  std::vector<float> least_;   ///< By code, the least float that has it; beyond the last infinity.
  std::vector<Start> starts_;  ///< By the upper bits of a float, from begin_ on.
};

}  // namespace nacre::host
