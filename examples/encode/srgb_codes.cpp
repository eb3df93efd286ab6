#include "examples/encode/srgb_codes.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace nacre::host {

namespace {

double curve(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double inverse(double coded) {
  return coded <= 12.92 * 0.0031308 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
}

/// The least float whose code is at least `code`.
float least_of(unsigned code, unsigned largest) {
  const auto reaches = [&](float x) {
    return largest * curve(static_cast<double>(x)) + 0.5 >= code;
  };
  auto x = static_cast<float>(inverse((code - 0.5) / largest));
  while (!reaches(x)) x = std::nextafter(x, 2.0f);
  for (float below = std::nextafter(x, 0.0f); reaches(below); below = std::nextafter(x, 0.0f)) {
    x = below;
  }
  return x;
}

}  // namespace

const SrgbCodes& SrgbCodes::with(unsigned largest) {
  if (largest == 255) {
    static const SrgbCodes bytes(255);
    return bytes;
  }
  static const SrgbCodes words(65535);
  return words;
}

// The upper bits leave an octave 128 steps, of which none holds two codes of 255, or 8192.
SrgbCodes::SrgbCodes(unsigned largest)
    : shift_(largest == 255 ? 16 : 10), has_steps_(largest != 255), least_(largest + 2) {
  for (unsigned code = 1; code <= largest; ++code) least_[code] = least_of(code, largest);
  least_.back() = std::numeric_limits<float>::infinity();
  begin_ = std::bit_cast<std::uint32_t>(least_[1]) >> shift_;
  const std::uint32_t end = (std::bit_cast<std::uint32_t>(1.0f) >> shift_) + 1;
  unsigned code = 0;
  for (std::uint32_t i = begin_; i < end; ++i) {
    const auto start = std::bit_cast<float>(i << shift_);
    while (least_[code + 1] <= start) ++code;
    starts_.push_back({least_[code + 1], code});
    assert(has_steps_ || code == largest ||
           least_[code + 2] >= std::bit_cast<float>((i + 1) << shift_));
  }
}

}  // namespace nacre::host
