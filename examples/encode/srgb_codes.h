#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace nacre::host {

/// The codes of IEC 61966-2-1 for linear values, correctly rounded: the code c of x is
/// floor(largest * f(x) + 1/2), f in double precision and x clamped to [0, 1]; NaN is 0.
///
/// A table has the least float of every code. Another one says, for the upper bits of a
/// float, which code is the first of those that begin so: from there it is a step or two.
class SrgbCodes {
 public:
  /// `largest` is 255 or 65535; the tables are made with the first one asked for.
  static const SrgbCodes& with(unsigned largest);

  unsigned operator()(float linear) const {
    if (!(linear >= least_[1])) return 0;
    if (linear >= least_.back()) return static_cast<unsigned>(least_.size()) - 1;
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(linear);
    unsigned code = first_[(bits >> shift_) - begin_];
    while (linear >= least_[code + 1]) ++code;
    return code;
  }

 private:
  explicit SrgbCodes(unsigned largest);

  int shift_;  ///< Lower bits of a float that the table of first codes leaves out.
  std::uint32_t begin_ = 0;
  std::vector<float> least_;          ///< By code, the least float that has it; [0] is unused.
  std::vector<std::uint16_t> first_;  ///< By the upper bits of a float, from begin_ on.
};

}  // namespace nacre::host
