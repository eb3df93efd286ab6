// EXR files as OpenEXR reads them.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "tests/examples/encode/written_image.h"

namespace nacre::host {
namespace {

/// Smooth, so that it is compressed, or noise, so that it is not.
Planes planes_of(int width, int height, std::size_t channels, bool is_noise) {
  Planes planes(channels);
  Noise noise;
  for (std::size_t c = 0; c < channels; ++c) {
    for (int i = 0; i < width * height; ++i) {
      const float any = noise.next();
      planes[c].push_back(is_noise ? 9.0f * any - 4.0f : static_cast<float>(i / 64 + int(c)));
    }
  }
  return planes;
}

class WrittenExr : public WrittenImage {};

ImageHeader header_of(int width, int height, std::size_t channels, SampleType samples) {
  return image_header(ImageKind::exr, width, height, channels, samples);
}

TEST_F(WrittenExr, IsReadBackBitForBit) {
  for (const bool is_noise : {false, true}) {
    for (const std::size_t channels : {1u, 3u, 4u, 9u}) {
      for (const int height : {1, 16, 17, 100}) {
        const Planes planes = planes_of(130, height, channels, is_noise);
        const std::string file =
            write(header_of(130, height, channels, SampleType::floating), planes);
        const std::size_t raw = planes[0].size() * channels * sizeof(float);
        if (height == 100) {
          EXPECT_EQ(std::filesystem::file_size(file) < raw, !is_noise);
        }
        const auto in = OIIO::ImageInput::open(file);
        ASSERT_NE(in, nullptr) << OIIO::geterror();
        ASSERT_EQ(in->spec().nchannels, static_cast<int>(channels));
        EXPECT_EQ(in->spec().get_string_attribute("DateTime"), "");
        std::vector<float> values(planes[0].size() * channels);
        ASSERT_TRUE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data()))
            << in->geterror();
        for (std::size_t i = 0; i < values.size(); ++i) {
          ASSERT_EQ(values[i], planes[i % channels][i / channels]);
        }
      }
    }
  }
}

TEST_F(WrittenExr, HalvesAreRoundedToEvenAndCutOff) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Planes planes{{1.0f, 1.0f + 1.0f / 2048.0f, 1.0f + 3.0f / 2048.0f, 1e9f, -1e9f, infinity,
                       -infinity, std::numeric_limits<float>::quiet_NaN()}};
  const auto in = OIIO::ImageInput::open(write(header_of(8, 1, 1, SampleType::half), planes));
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::HALF);
  std::vector<float> values(8);
  ASSERT_TRUE(in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data()));
  const std::vector<float> right{1.0f,     1.0f,     1.0f + 4.0f / 2048.0f, 65504.0f, -65504.0f,
                                 infinity, -infinity};
  for (std::size_t i = 0; i < right.size(); ++i) EXPECT_EQ(values[i], right[i]);
  EXPECT_TRUE(std::isnan(values[7]));
}

TEST_F(WrittenExr, SaysAColourSpaceThatIsNotLinear) {
  ImageHeader header = header_of(2, 2, 3, SampleType::floating);
  header.colorspace = "acescg";
  const auto in = OIIO::ImageInput::open(write(header, planes_of(2, 2, 3, false)));
  EXPECT_EQ(in->spec().get_string_attribute("oiio:ColorSpace"), "acescg");
}

}  // namespace
}  // namespace nacre::host
