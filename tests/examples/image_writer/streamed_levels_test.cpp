// Textures that are written while they are made, beside those that OpenImageIO makes of whole
// images.
#include "examples/image_writer/streamed_levels.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <random>

#include "examples/image_writer/levels.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

struct Level {
  OIIO::ImageSpec spec;
  std::vector<float> texels;
};

std::vector<Level> levels_of(const std::string& path) {
  std::vector<Level> levels;
  const auto in = OIIO::ImageInput::open(path);
  if (!in) return levels;
  for (int level = 0; in->seek_subimage(0, level); ++level) {
    Level& one = levels.emplace_back(in->spec());
    one.texels.resize(one.spec.image_pixels() * static_cast<std::size_t>(one.spec.nchannels));
    EXPECT_TRUE(
        in->read_image(0, level, 0, one.spec.nchannels, OIIO::TypeDesc::FLOAT, one.texels.data()));
  }
  return levels;
}

ImageHeader header_of(int width, int height, std::size_t channels) {
  ImageHeader header{.kind = ImageKind::tx,
                     .width = width,
                     .height = height,
                     .channels = {"R", "G", "B", "A"},
                     .samples = SampleType::floating,
                     .colorspace = "Linear",
                     .repeats = false};
  header.channels.resize(channels);
  return header;
}

class Streamed : public ::testing::TestWithParam<std::array<int, 3>> {};

TEST_P(Streamed, LevelsAreThoseOfAWholeImage) {
  const TemporaryFolder folder;
  const auto [width, height, channels] = GetParam();
  const ImageHeader header = header_of(width, height, static_cast<std::size_t>(channels));
  std::mt19937 random(5489);
  std::uniform_real_distribution<float> numbers(-1.0f, 3.0f);
  std::vector<std::vector<float>> planes(header.channels.size());
  for (auto& plane : planes) {
    plane.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (float& number : plane) number = numbers(random);
  }
  std::string problem;
  const auto streamed = stream_levels(folder.file("a.tx"), header, problem);
  ASSERT_NE(streamed, nullptr) << problem;
  EXPECT_EQ(write_planes(*streamed, header, planes), "");
  EXPECT_EQ(write_planes(*write_levels(folder.file("b.tx"), header), header, planes), "");
  const std::vector<Level> a = levels_of(folder.file("a.tx"));
  const std::vector<Level> b = levels_of(folder.file("b.tx"));
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 1u);
  for (std::size_t level = 0; level < a.size(); ++level) {
    EXPECT_EQ(a[level].spec.width, b[level].spec.width);
    EXPECT_EQ(a[level].spec.height, b[level].spec.height);
    EXPECT_EQ(a[level].spec.tile_width, b[level].spec.tile_width);
    EXPECT_EQ(a[level].spec.format, b[level].spec.format);
    ASSERT_EQ(a[level].texels.size(), b[level].texels.size());
    for (std::size_t i = 0; i < a[level].texels.size(); ++i) {
      ASSERT_NEAR(a[level].texels[i], b[level].texels[i], 1e-5f) << level << ' ' << i;
    }
  }
  for (const char* const name : {"wrapmodes", "textureformat", "compression"}) {
    EXPECT_EQ(a[0].spec.get_string_attribute(name), b[0].spec.get_string_attribute(name)) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Streamed,
                         ::testing::Values(std::array{256, 128, 3}, std::array{64, 512, 1},
                                           std::array{2, 2, 4}, std::array{1, 8, 1}));

TEST(StreamedImages, IsWhatIsLargeAndHalvesEvenly) {
  EXPECT_TRUE(is_streamed(header_of(16384, 16384, 3)));
  EXPECT_FALSE(is_streamed(header_of(2048, 2048, 4)));
  EXPECT_FALSE(is_streamed(header_of(16384, 16380, 3)));
}

}  // namespace
}  // namespace nacre::host
