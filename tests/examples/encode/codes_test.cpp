// Codes of integer files are correctly rounded: at every place where one begins, and between.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "examples/encode/sample_codes.h"
#include "examples/encode/srgb_codes.h"

namespace nacre::host {
namespace {

/// IEC 61966-2-1 in long double, largest * f(x) + 1/2 before it is cut.
long double srgb_place(float x, unsigned largest) {
  const auto linear = static_cast<long double>(x);
  const long double coded =
      linear <= 0.0031308L ? 12.92L * linear : 1.055L * std::pow(linear, 1.0L / 2.4L) - 0.055L;
  return largest * coded + 0.5L;
}

unsigned srgb_code(float x, unsigned largest) {
  if (!(x > 0.0f)) return 0;
  return x >= 1.0f ? largest : static_cast<unsigned>(srgb_place(x, largest));
}

template <class Code>
Code code_of(float x, bool is_srgb) {
  Code code = 0;
  put_codes(&x, 1, is_srgb, &code, 1);
  return code;
}

/// The least positive float for which `reaches` is true, by halving all there are.
template <class Reaches>
float least_float(const Reaches& reaches) {
  std::uint32_t no = 0;
  std::uint32_t yes = std::bit_cast<std::uint32_t>(1.0f);
  while (yes - no > 1) {
    const std::uint32_t middle = no + (yes - no) / 2;
    (reaches(std::bit_cast<float>(middle)) ? yes : no) = middle;
  }
  return std::bit_cast<float>(yes);
}

template <class Code>
void expect_every_boundary() {
  constexpr unsigned largest = std::numeric_limits<Code>::max();
  for (unsigned code = 1; code <= largest; ++code) {
    const float least = least_float([&](float x) { return srgb_place(x, largest) >= code; });
    ASSERT_EQ(code_of<Code>(least, true), code) << least;
    ASSERT_EQ(code_of<Code>(std::nextafter(least, 0.0f), true), code - 1) << least;
  }
}

TEST(SrgbCodesTest, EveryByteBeginsWhereItShould) { expect_every_boundary<std::uint8_t>(); }

TEST(SrgbCodesTest, EveryWordBeginsWhereItShould) { expect_every_boundary<std::uint16_t>(); }

TEST(SrgbCodesTest, IsRightBetween) {
  std::uint32_t seed = 1;
  for (int i = 0; i < 1'000'000; ++i) {
    seed = seed * 1664525u + 1013904223u;
    const float x = static_cast<float>(seed >> 8) / float(1 << 24) * (i % 3 == 0 ? 0.01f : 1.0f);
    ASSERT_EQ(code_of<std::uint8_t>(x, true), srgb_code(x, 255)) << x;
    ASSERT_EQ(code_of<std::uint16_t>(x, true), srgb_code(x, 65535)) << x;
  }
}

TEST(SampleCodes, ClampWhatTheyCannotHold) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const std::vector<std::pair<float, unsigned>> values = {
      {-1.0f, 0},   {-0.0f, 0},      {-infinity, 0},
      {0.0f, 0},    {1.0f, 255},     {std::nextafter(1.0f, 2.0f), 255},
      {1e30f, 255}, {infinity, 255}, {std::numeric_limits<float>::quiet_NaN(), 0},
      {1e-40f, 0}};
  for (const bool is_srgb : {false, true}) {
    for (const auto& [value, code] : values) {
      EXPECT_EQ(code_of<std::uint8_t>(value, is_srgb), code) << value;
      EXPECT_EQ(code_of<std::uint16_t>(value, is_srgb), code * 257) << value;
    }
  }
}

// A product of a float and a code has fewer bits than a double: what is compared is exact.
TEST(SampleCodes, OfLinearNumbersBeginHalfWay) {
  for (unsigned code = 1; code <= 65535; ++code) {
    const auto half = (static_cast<double>(code) - 0.5) / 65535.0;
    float x = static_cast<float>(half);
    while (static_cast<double>(x) * 65535.0 < code - 0.5) x = std::nextafter(x, 2.0f);
    while (static_cast<double>(std::nextafter(x, 0.0f)) * 65535.0 >= code - 0.5) {
      x = std::nextafter(x, 0.0f);
    }
    ASSERT_EQ(code_of<std::uint16_t>(x, false), code);
    ASSERT_EQ(code_of<std::uint16_t>(std::nextafter(x, 0.0f), false), code - 1);
  }
}

}  // namespace
}  // namespace nacre::host
