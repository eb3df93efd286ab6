#include "examples/encode/sample_codes.h"

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
  for (std::size_t i = 0; i < count; ++i) {
    const float value = values[i] > 0.0f ? values[i] : 0.0f;  // NaN is not above 0.
    const double clamped = value < 1.0f ? static_cast<double>(value) : 1.0;
    // The product has 40 bits at most, so that nothing is rounded before it is cut.
    codes[i * stride] = static_cast<Code>(static_cast<int>(clamped * largest + 0.5));
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
