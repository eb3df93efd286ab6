#include "runtime/texture/texel.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace nacre {
namespace {

using texture_layout::TexelFormat;

/// IEEE 754-2008, 3.4, binary16.
double half_value(unsigned half) {
  const int exponent = static_cast<int>(half >> 10 & 31);
  const double fraction = half & 1023;
  const double magnitude =
      exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return half >> 15 ? -magnitude : magnitude;
}

TEST(Texel, EveryFiniteHalfHasItsIeeeValueAndComesBack) {
  for (unsigned half = 0; half < 0x10000; ++half) {
    if ((half & 0x7c00) == 0x7c00) continue;
    const float value = half_to_float(static_cast<std::uint16_t>(half));
    ASSERT_EQ(static_cast<double>(value), half_value(half)) << half;
    ASSERT_EQ(float_to_half(value), half) << half;
  }
}

TEST(Texel, HalfIsTheNearestOneTiesToEven) {
  std::mt19937 random(7);
  std::uniform_int_distribution<unsigned> halves(0, 0x7bfe);
  for (int i = 0; i < 100'000; ++i) {
    const unsigned low = halves(random);
    const double a = half_value(low);
    const double b = half_value(low + 1);
    const auto middle = static_cast<float>((a + b) / 2);  // Exact.
    EXPECT_EQ(float_to_half(middle), low % 2 == 0 ? low : low + 1);
    EXPECT_EQ(float_to_half(std::nextafter(middle, 0.f)), low);
    EXPECT_EQ(float_to_half(std::nextafter(middle, 1e9f)), low + 1);
    EXPECT_EQ(float_to_half(-std::nextafter(middle, 0.f)), low | 0x8000);
  }
}

TEST(Texel, HalfClampsAtItsLargest) {
  EXPECT_EQ(float_to_half(65504.f), 0x7bff);
  EXPECT_EQ(float_to_half(65519.f), 0x7bff);
  EXPECT_EQ(float_to_half(3e38f), 0x7bff);
  EXPECT_EQ(float_to_half(-3e38f), 0xfbff);
}

TEST(Texel, SanitisedReplacesAndCountsWhatIsNotFinite) {
  std::uint64_t replaced = 0;
  EXPECT_EQ(sanitised(std::numeric_limits<float>::quiet_NaN(), replaced), 0.f);
  EXPECT_EQ(sanitised(std::numeric_limits<float>::infinity(), replaced), 0.f);
  EXPECT_EQ(sanitised(-std::numeric_limits<float>::infinity(), replaced), 0.f);
  EXPECT_EQ(replaced, 3u);
  EXPECT_EQ(sanitised(std::bit_cast<float>(0x007fffffu), replaced), 0.f);
  EXPECT_EQ(sanitised(std::bit_cast<float>(0x80000001u), replaced), 0.f);
  EXPECT_EQ(sanitised(std::numeric_limits<float>::min(), replaced),
            std::numeric_limits<float>::min());
  EXPECT_EQ(sanitised(-std::numeric_limits<float>::max(), replaced),
            -std::numeric_limits<float>::max());
  EXPECT_EQ(replaced, 3u);
}

TEST(Texel, UnsignedFormatsRoundToNearestAndClamp) {
  std::uint32_t words[2]{};
  encode_texel(TexelFormat::rgba8, {-1.f, 2.f, 0.49f / 255.f, 0.51f / 255.f}, words);
  EXPECT_EQ(words[0], 0x0100ff00u);
  encode_texel(TexelFormat::rgba16, {-1.f, 2.f, 1.f / 65535.f, 0.5f}, words);
  EXPECT_EQ(words[0], 0xffff0000u);
  EXPECT_EQ(words[1], 0x80000001u);
}

TEST(Texel, IntegersOfFilesSurviveTheWayThroughFloat) {
  std::uint32_t words[2]{};
  for (unsigned i = 0; i < 65536; ++i) {
    const float value = static_cast<float>(i) / 65535.f;
    encode_texel(TexelFormat::rgba16, {value, 0.f, 0.f, 1.f}, words);
    ASSERT_EQ(words[0] & 0xffff, i);
    if (i > 255) continue;
    encode_texel(TexelFormat::rgba8, {static_cast<float>(i) / 255.f, 0.f, 0.f, 1.f}, words);
    ASSERT_EQ(words[0] & 0xff, i);
  }
}

TEST(Texel, OneChannelReadsAsRedWithOpaqueAlpha) {
  std::uint32_t word = 0;
  encode_texel(TexelFormat::r32f, {0.25f, 0.f, 0.f, 1.f}, &word);
  EXPECT_EQ(decode_texel(TexelFormat::r32f, &word), (Rgba{0.25f, 0.f, 0.f, 1.f}));
}

}  // namespace
}  // namespace nacre
