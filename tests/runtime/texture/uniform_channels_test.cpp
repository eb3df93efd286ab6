// Which channels are the same in all texels, beside a look at every texel that is decoded.

#include "runtime/texture/uniform_channels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "runtime/texture/texel.h"
#include "runtime/texture/texture_loader.h"
#include "runtime/texture/texture_store.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

struct Format {
  const char* file;
  const char* type;
  int channels;
  int steps;
};
constexpr Format formats[] = {{"a.png", "uint8", 4, 255},    {"b.png", "uint8", 3, 255},
                              {"c.exr", "float", 1, 1024},   {"d.png", "uint16", 4, 65535},
                              {"e.exr", "half", 2, 1024},    {"f.exr", "half", 4, 1024},
                              {"g.exr", "float", 4, 1 << 20}};

class Uniform : public testing::Test {
 protected:
  TextureHandle load(const Format& format, const TestImage& image) {
    // A file of its own each time.
    const std::string path = folder_.file(std::to_string(++files_) + format.file);
    WriteOptions options;
    options.type = format.type;
    EXPECT_TRUE(write_image(path, image, options));
    Diagnostics diagnostics;
    const TextureHandle texture = store_.acquire({.path = path, .layer = {}}, diagnostics);
    EXPECT_TRUE(texture->resident()) << diagnostics.to_string();
    return texture;
  }

  TemporaryFolder folder_;
  TextureStore store_;
  int files_ = 0;
};

/// In values, by decoding every texel.
std::array<std::optional<float>, 4> by_texels(const Texture& texture) {
  using namespace texture_layout;
  const auto words = texture.words();
  const Plan plan =
      texture_layout::plan(static_cast<TexelFormat>(words[word_format]), texture.width(),
                           texture.height(), static_cast<int>(words[word_channels]));
  std::array<std::optional<float>, 4> uniform;
  std::array<bool, 4> differs{};
  const auto count = static_cast<std::size_t>(plan.channels);
  for (int y = 0; y < plan.height; ++y) {
    for (int x = 0; x < plan.width; ++x) {
      const Rgba texel = decode_texel(plan.format, words.data() + texel_index(plan, 0, x, y));
      for (std::size_t c = 0; c < count; ++c) {
        differs[c] = differs[c] || (uniform[c] && *uniform[c] != texel[c]);
        uniform[c] = texel[c];
      }
    }
  }
  for (std::size_t c = 0; c < count; ++c) {
    if (differs[c]) uniform[c].reset();
  }
  return uniform;
}

TEST_F(Uniform, ChannelsOfEveryFormatAreFound) {
  for (const Format& format : formats) {
    for (const auto& [width, height] :
         {std::pair{1, 1}, {1, 5}, {3, 1}, {8, 8}, {13, 7}, {61, 33}}) {
      for (int flat = 0; flat < 1 << format.channels; ++flat) {
        TestImage image = random_image(width, height, format.channels, format.steps, 5);
        for (int c = 0; c < format.channels; ++c) {
          if ((flat >> c & 1) == 0) continue;
          for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) image.at(x, y, c) = c == 3 ? 1.0f : 0.2f * float(c);
          }
        }
        const TextureHandle texture = load(format, image);
        const auto expected = by_texels(*texture);
        const float step = format.type == std::string("uint8")    ? 1.0f / 255.0f
                           : format.type == std::string("uint16") ? 1.0f / 65535.0f
                                                                  : 1.0f;
        for (std::size_t c = 0; c < 4; ++c) {
          const std::optional<float> found = texture->uniform()[c];
          ASSERT_EQ(found.has_value(), expected[c].has_value())
              << format.file << width << flat << c;
          if (found) {
            EXPECT_EQ(*found * step, *expected[c]) << format.file;
          }
        }
      }
    }
  }
}

TEST_F(Uniform, OneTexelAnywhereMakesThemDiffer) {
  for (const Format& format : formats) {
    for (const auto& [x, y] : {std::pair{0, 0}, {60, 0}, {7, 8}, {56, 31}, {60, 32}}) {
      TestImage image{61, 33, format.channels, {}};
      image.samples.assign(static_cast<std::size_t>(61 * 33 * format.channels), 0.4f);
      const int last = format.channels - 1;
      image.at(x, y, last) = 0.6f;
      const TextureHandle texture = load(format, image);
      for (int c = 0; c < 4; ++c) {
        EXPECT_EQ(texture->uniform()[static_cast<std::size_t>(c)].has_value(), c < last)
            << format.file << ' ' << x << ' ' << y;
      }
    }
  }
}

// Filters give 0 for texels of -0, and the store has none.
TEST_F(Uniform, ZeroHasNoSign) {
  for (const Format& format : {formats[2], formats[4]}) {
    TestImage image{4, 4, format.channels, {}};
    image.samples.assign(static_cast<std::size_t>(16 * format.channels), -0.0f);
    image.samples[3] = 0.0f;
    const std::optional<float> zero = load(format, image)->uniform()[0];
    ASSERT_TRUE(zero.has_value());
    EXPECT_FALSE(std::signbit(*zero));
  }
}

TEST_F(Uniform, NothingIsKnownOfWhatIsNotResident) {
  Diagnostics diagnostics;
  const TextureHandle missing =
      store_.acquire({.path = folder_.file("none.png"), .layer = {}}, diagnostics);
  TestImage image{16, 16, 1, std::vector<float>(256, 0.5f)};
  WriteOptions floats;
  floats.type = "float";
  ASSERT_TRUE(write_image(folder_.file("large.exr"), image, floats));
  TextureOptions no_room;
  no_room.budget = 0;
  TextureStore none(no_room);
  const TextureHandle tiled =
      none.acquire({.path = folder_.file("large.exr"), .layer = {}}, diagnostics);
  for (const TextureHandle& texture : {missing, tiled}) {
    EXPECT_FALSE(texture->resident());
    EXPECT_EQ(texture->uniform(), UniformChannels{});
  }
}

}  // namespace
}  // namespace nacre
