#include "examples/encode/sample_codes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "examples/encode/srgb_codes.h"

namespace nacre::host {

namespace {

template <class Code>
void put(const float* values, std::size_t count, bool is_srgb, Code* codes, std::size_t stride) {
  constexpr unsigned largest = std::numeric_limits<Code>::max();
  if (is_srgb) {
    const SrgbCodes& code_of = SrgbCodes::with(largest);
    for (std::size_t i = 0; i < count; ++i) {
      codes[i * stride] = static_cast<Code>(code_of(values[i]));
    }
    return;
  }
  // In two steps, of which the compiler does the first with several at once.
  constexpr std::size_t at_once = 256;
  std::array<std::int32_t, at_once> found;
  for (std::size_t begin = 0; begin < count; begin += at_once) {
    const std::size_t some = std::min(at_once, count - begin);
    for (std::size_t i = 0; i < some; ++i) {
      const float value = values[begin + i];
      const float positive = value > 0.0f ? value : 0.0f;  // NaN is not above 0.
      const float clamped = positive < 1.0f ? positive : 1.0f;
      // The product has 40 bits at most, so that nothing is rounded before it is cut.
      found[i] = static_cast<std::int32_t>(static_cast<double>(clamped) * largest + 0.5);
    }
    for (std::size_t i = 0; i < some; ++i) {
      codes[(begin + i) * stride] = static_cast<Code>(found[i]);
    }
  }
}

}  // namespace

void put_codes(const float* values, std::size_t count, bool is_srgb, std::uint8_t* codes,
               std::size_t stride) {
  put(values, count, is_srgb, codes, stride);
}

void put_codes(const float* values, std::size_t count, bool is_srgb, std::uint16_t* codes,
               std::size_t stride) {
  put(values, count, is_srgb, codes, stride);
}

}  // namespace nacre::host
