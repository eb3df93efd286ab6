#include "runtime/texture/texture_store.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "runtime/texture/texel.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

TextureOptions budget_of(std::uint64_t bytes) {
  TextureOptions options;
  options.budget = bytes;
  return options;
}

using namespace texture_layout;

class TextureStoreTest : public testing::Test {
 protected:
  TextureKey write(const std::string& name, const TestImage& image, const char* type = "uint8",
                   TexelPolicy policy = TexelPolicy::automatic) {
    WriteOptions options;
    options.type = type;
    EXPECT_TRUE(write_image(folder_.file(name), image, options));
    return {folder_.file(name), "", policy};
  }

  static Rgba texel(const Texture& texture, int level, int x, int y) {
    const auto words = texture.words();
    const auto format = static_cast<TexelFormat>(words[word_format]);
    const Plan planned = plan(format, texture.width(), texture.height(), 4);
    return decode_texel(format, &words[texel_index(planned, level, x, y)]);
  }

  static TexelFormat format(const Texture& texture) {
    return static_cast<TexelFormat>(texture.words()[word_format]);
  }

  static std::uint64_t bytes(int width, int height, TexelFormat format) {
    return plan(format, width, height, 4).bytes();
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(TextureStoreTest, HoldsEveryTexelBottomRowFirst) {
  struct Case {
    const char* name;
    const char* type;
    int channels;
    int steps;
    TexelFormat format;
  };
  for (const Case& one : {Case{"a.png", "uint8", 1, 255, TexelFormat::r32f},
                          Case{"b.png", "uint8", 3, 255, TexelFormat::rgba8},
                          Case{"c.png", "uint8", 4, 255, TexelFormat::rgba8},
                          Case{"d.png", "uint16", 1, 65535, TexelFormat::r32f},
                          Case{"e.png", "uint16", 3, 65535, TexelFormat::rgba16},
                          Case{"f.exr", "half", 1, 1024, TexelFormat::r32f},
                          Case{"g.exr", "half", 4, 1024, TexelFormat::rgba16f},
                          Case{"h.exr", "float", 3, 1 << 20, TexelFormat::rgba32f},
                          Case{"i.exr", "float", 1, 1 << 20, TexelFormat::r32f}}) {
    for (const auto& [width, height] :
         std::initializer_list<std::pair<int, int>>{{1, 1}, {1, 9}, {17, 5}, {256, 256}}) {
      const TestImage image = random_image(width, height, one.channels, one.steps);
      TextureStore store;
      const TextureHandle texture = store.acquire(write(one.name, image, one.type), diagnostics_);
      ASSERT_TRUE(texture->resident()) << diagnostics_.to_string();
      ASSERT_EQ(format(*texture), one.format) << one.name;
      EXPECT_EQ(texture->words()[word_channels], static_cast<std::uint32_t>(one.channels));
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(texture->words().data()) % alignment, 0u);
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const Rgba value = texel(*texture, 0, x, y);
          for (int c = 0; c < 4; ++c) {
            const float expected = c < one.channels ? image.at(x, y, c) : c == 3 ? 1.f : 0.f;
            ASSERT_NEAR(value[static_cast<std::size_t>(c)], expected, 1e-7)
                << one.name << " " << x << "," << y;
          }
        }
      }
    }
  }
}

TEST_F(TextureStoreTest, PolicyChoosesTheFormat) {
  TextureStore store;
  const auto format_of = [&](const char* type, int channels, TexelPolicy policy) {
    const TextureKey key = write("a.tif", random_image(4, 4, channels, 255), type, policy);
    store.drop_unused();
    return format(*store.acquire(key, diagnostics_));
  };
  EXPECT_EQ(format_of("uint8", 3, TexelPolicy::half), TexelFormat::rgba8);
  EXPECT_EQ(format_of("uint8", 3, TexelPolicy::full), TexelFormat::rgba32f);
  EXPECT_EQ(format_of("uint16", 3, TexelPolicy::half), TexelFormat::rgba16);
  EXPECT_EQ(format_of("uint16", 3, TexelPolicy::full), TexelFormat::rgba32f);
  EXPECT_EQ(format_of("float", 3, TexelPolicy::half), TexelFormat::rgba16f);
  EXPECT_EQ(format_of("float", 4, TexelPolicy::automatic), TexelFormat::rgba32f);
  EXPECT_EQ(format_of("float", 1, TexelPolicy::half), TexelFormat::r32f);
}

TEST_F(TextureStoreTest, TexelsThatAreNotFiniteBecomeZeroAndAreCounted) {
  TestImage image = random_image(8, 8, 3, 255);
  image.at(1, 2, 0) = std::numeric_limits<float>::quiet_NaN();
  image.at(3, 4, 1) = std::numeric_limits<float>::infinity();
  image.at(5, 6, 2) = -std::numeric_limits<float>::infinity();
  image.at(7, 7, 0) = 1e-40f;
  TextureStore store;
  const TextureHandle texture = store.acquire(write("a.exr", image, "float"), diagnostics_);
  EXPECT_EQ(texel(*texture, 0, 1, 2)[0], 0.f);
  EXPECT_EQ(texel(*texture, 0, 3, 4)[1], 0.f);
  EXPECT_EQ(texel(*texture, 0, 5, 6)[2], 0.f);
  EXPECT_EQ(texel(*texture, 0, 7, 7)[0], 0.f);
  EXPECT_EQ(texture->replaced_texels(), 3u);
  EXPECT_EQ(store.statistics().replaced_texels, 3u);
}

TEST_F(TextureStoreTest, SameKeySharesOneTexture) {
  const TextureKey key = write("a.png", random_image(8, 8, 3, 255));
  TextureStore store;
  const TextureHandle first = store.acquire(key, diagnostics_);
  const TextureHandle second = store.acquire(key, diagnostics_);
  TextureKey full = key;
  full.policy = TexelPolicy::full;
  const TextureHandle other = store.acquire(full, diagnostics_);
  EXPECT_EQ(first, second);
  EXPECT_NE(first, other);
  EXPECT_EQ(store.statistics().loads, 2u);
  EXPECT_EQ(store.statistics().hits, 1u);
  EXPECT_EQ(store.statistics().resident_bytes,
            first->words().size_bytes() + other->words().size_bytes());
}

TEST_F(TextureStoreTest, UnusedTextureMakesRoomTheOldestFirst) {
  const auto one = bytes(32, 32, TexelFormat::rgba8);
  TextureStore store(budget_of(2 * one));
  const TextureKey a = write("a.png", random_image(32, 32, 3, 255));
  const TextureKey b = write("b.png", random_image(32, 32, 3, 255));
  const TextureKey c = write("c.png", random_image(32, 32, 3, 255));
  store.acquire(a, diagnostics_);
  store.acquire(b, diagnostics_);
  store.acquire(a, diagnostics_);
  store.acquire(c, diagnostics_);  // b goes.
  EXPECT_EQ(store.statistics().evictions, 1u);
  EXPECT_EQ(store.statistics().loads, 3u);
  store.acquire(a, diagnostics_);
  EXPECT_EQ(store.statistics().loads, 3u);
  store.acquire(b, diagnostics_);
  EXPECT_EQ(store.statistics().loads, 4u);
  EXPECT_LE(store.statistics().peak_resident_bytes, 2 * one);
}

TEST_F(TextureStoreTest, OverTheBudgetTheHostServesUntilThereIsRoom) {
  const auto one = bytes(32, 32, TexelFormat::rgba8);
  TextureStore store(budget_of(one));
  const TextureKey a = write("a.png", random_image(32, 32, 3, 255));
  const TextureKey b = write("b.png", random_image(32, 32, 3, 255));
  TextureHandle first = store.acquire(a, diagnostics_);
  TextureHandle second = store.acquire(b, diagnostics_);
  EXPECT_TRUE(first->resident());
  ASSERT_FALSE(second->resident());
  ASSERT_NE(second->sampler(), nullptr);
  EXPECT_FALSE(second->missing());
  EXPECT_EQ(second->width(), 32);
  EXPECT_EQ(second->words()[word_flags], texture_by_call);
  EXPECT_EQ(second->words()[word_width], 1u);
  EXPECT_EQ(store.statistics().tiled_textures, 1u);
  EXPECT_EQ(diagnostics_.all().size(), 0u);

  first.reset();
  EXPECT_EQ(store.acquire(b, diagnostics_), second) << "a texture in use does not change";
  second.reset();
  EXPECT_TRUE(store.acquire(b, diagnostics_)->resident());
  EXPECT_EQ(store.statistics().resident_bytes, one);
}

TEST_F(TextureStoreTest, ImageLargerThanTheBudgetDoesNotEmptyTheStore) {
  TextureStore store(budget_of(bytes(32, 32, TexelFormat::rgba8)));
  store.acquire(write("a.png", random_image(32, 32, 3, 255)), diagnostics_);
  const TextureHandle large =
      store.acquire(write("b.png", random_image(64, 64, 3, 255)), diagnostics_);
  EXPECT_NE(large->sampler(), nullptr);
  EXPECT_EQ(store.statistics().evictions, 0u);
  EXPECT_EQ(store.statistics().resident_textures, 1u);
}

TEST_F(TextureStoreTest, DropUnusedReadsChangedFilesAgain) {
  TextureStore store;
  const TextureKey key = write("a.png", random_image(4, 4, 3, 255, 1));
  const Rgba before = texel(*store.acquire(key, diagnostics_), 0, 0, 0);
  write("a.png", random_image(4, 4, 3, 255, 2));
  store.drop_unused();
  EXPECT_EQ(store.statistics().resident_bytes, 0u);
  EXPECT_NE(texel(*store.acquire(key, diagnostics_), 0, 0, 0), before);
}

/// Written again within a second, with as many bytes, while the old texture is held.
TEST_F(TextureStoreTest, AChangedFileIsAnotherTextureAndTheOldOneStays) {
  TextureStore store;
  const TestImage first = random_image(4, 4, 3, 255, 1), second = random_image(4, 4, 3, 255, 2);
  const TextureKey key = write("a.tif", first);
  const TextureHandle old = store.acquire(key, diagnostics_);
  const auto size = std::filesystem::file_size(key.path);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // Some ticks of the clock.
  write("a.tif", second);
  ASSERT_EQ(std::filesystem::file_size(key.path), size);
  const TextureHandle fresh = store.acquire(key, diagnostics_);
  EXPECT_NEAR(texel(*old, 0, 1, 2)[0], first.at(1, 2, 0), 1e-6);
  EXPECT_NEAR(texel(*fresh, 0, 1, 2)[0], second.at(1, 2, 0), 1e-6);
  EXPECT_EQ(store.acquire(key, diagnostics_), fresh);
  EXPECT_EQ(store.statistics().loads, 2u);

  // Another file under the same name, as careful programs write.
  write("b.tif", first);
  std::filesystem::rename(folder_.file("b.tif"), key.path);
  EXPECT_NEAR(texel(*store.acquire(key, diagnostics_), 0, 1, 2)[0], first.at(1, 2, 0), 1e-6);
  EXPECT_EQ(store.statistics().resident_textures, 3u)
      << "all three are held or were just asked for";
}

/// Through the host too; what of the old file was not read is gone, and counted.
TEST_F(TextureStoreTest, AChangedFileOnTheHostIsAnotherTexture) {
  TextureStore store(budget_of(0));
  const TestImage first = random_image(200, 200, 1, 255, 1);
  const TextureKey key = write("a.tif", first);
  const auto look_up = [](const Texture& texture) {
    const float u = 3.5f / 200, v = 4.5f / 200;
    std::array<float, 4> value{};
    TextureLookup lookup;
    lookup.count = 1;
    lookup.u = &u;
    lookup.v = &v;
    lookup.filter = TextureFilter::closest;
    texture.sampler()->lookup(lookup, {&value[0], &value[1], &value[2], &value[3]});
    return value[0];
  };
  const TextureHandle seen = store.acquire(key, diagnostics_);
  ASSERT_NE(seen->sampler(), nullptr);
  EXPECT_NEAR(look_up(*seen), first.at(3, 4, 0), 1e-6);
  const TestImage second = random_image(200, 200, 1, 255, 2);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  write("a.tif", second);
  const TextureHandle fresh = store.acquire(key, diagnostics_);
  ASSERT_NE(fresh->sampler(), nullptr);
  EXPECT_NEAR(look_up(*fresh), second.at(3, 4, 0), 1e-6);
  EXPECT_NEAR(look_up(*seen), first.at(3, 4, 0), 1e-6);
}

/// The format is the contents' here too: the cache would choose a reader by the name.
TEST_F(TextureStoreTest, TheHostReadsByContentsNotByName) {
  TextureStore store(budget_of(0));
  const TestImage image = random_image(64, 64, 3, 255);
  write("a.tif", image);
  std::filesystem::rename(folder_.file("a.tif"), folder_.file("a.dds"));
  const TextureHandle texture = store.acquire({folder_.file("a.dds"), "", {}}, diagnostics_);
  ASSERT_NE(texture->sampler(), nullptr);
  EXPECT_EQ(store.statistics().read_failures, 0u);
}

TEST_F(TextureStoreTest, HandlesOutliveTheStore) {
  const TestImage image = random_image(32, 32, 3, 255);
  TextureHandle resident;
  TextureHandle tiled;
  {
    TextureStore store(budget_of(bytes(32, 32, TexelFormat::rgba8)));
    resident = store.acquire(write("a.png", image), diagnostics_);
    tiled = store.acquire(write("b.png", image), diagnostics_);
  }
  EXPECT_NEAR(texel(*resident, 0, 3, 4)[1], image.at(3, 4, 1), 1e-7);
  ASSERT_NE(tiled->sampler(), nullptr);
  const float u = 3.5f / 32;
  const float v = 4.5f / 32;
  std::array<float, 4> value{};
  TextureLookup lookup;
  lookup.count = 1;
  lookup.u = &u;
  lookup.v = &v;
  lookup.filter = TextureFilter::closest;
  tiled->sampler()->lookup(lookup, {&value[0], &value[1], &value[2], &value[3]});
  EXPECT_NEAR(value[1], image.at(3, 4, 1), 1e-7);
}

TEST_F(TextureStoreTest, EightThreadsLoadOneImageOnce) {
  const TextureKey key = write("a.png", random_image(256, 256, 3, 255));
  TextureStore store;
  std::vector<TextureHandle> handles(8);
  std::vector<Diagnostics> diagnostics(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] { handles[i] = store.acquire(key, diagnostics[i]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const TextureHandle& handle : handles) EXPECT_EQ(handle, handles[0]);
  EXPECT_TRUE(handles[0]->resident());
  EXPECT_EQ(store.statistics().loads, 1u);
  EXPECT_EQ(store.statistics().hits, 7u);
}

TEST_F(TextureStoreTest, EightThreadsHearOfOneMissingImageEach) {
  TextureStore store;
  std::vector<TextureHandle> handles(8);
  std::vector<Diagnostics> diagnostics(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] {
      handles[i] = store.acquire({folder_.file("nowhere.exr"), "", {}}, diagnostics[i]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_TRUE(handles[i]->missing());
    EXPECT_EQ(diagnostics[i].error_count(), 1u);
  }
}

// Threads fight over a budget of three images out of ten: every handle must hold its own
// image, wherever it is served from, and the account must balance at the end.
TEST_F(TextureStoreTest, ThreadsOverABudgetAlwaysSeeTheirOwnImage) {
  const auto one = bytes(16, 16, TexelFormat::rgba8);
  TextureStore store(budget_of(3 * one));
  std::vector<TextureKey> keys;
  std::vector<TestImage> images;
  for (unsigned i = 0; i < 10; ++i) {
    images.push_back(random_image(16, 16, 3, 255, i));
    keys.push_back(write("image" + std::to_string(i) + ".png", images.back()));
  }
  std::vector<std::thread> threads;
  std::vector<int> wrong(8);
  for (std::size_t t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      Diagnostics diagnostics;
      for (std::size_t round = 0; round < 40; ++round) {
        const std::size_t i = (t * 7 + round * (t + 3)) % keys.size();
        const TextureHandle texture = store.acquire(keys[i], diagnostics);
        float value = 0;
        if (texture->resident()) {
          value = texel(*texture, 0, 5, 11)[1];
        } else if (texture->sampler()) {
          const float u = 5.5f / 16;
          const float v = 11.5f / 16;
          std::array<float, 4> out{};
          TextureLookup lookup;
          lookup.count = 1;
          lookup.u = &u;
          lookup.v = &v;
          lookup.filter = TextureFilter::closest;
          texture->sampler()->lookup(lookup, {&out[0], &out[1], &out[2], &out[3]});
          value = out[1];
        }
        if (std::abs(value - images[i].at(5, 11, 1)) > 1e-6f) ++wrong[t];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const int count : wrong) EXPECT_EQ(count, 0);
  EXPECT_LE(store.statistics().peak_resident_bytes, 3 * one);
  store.drop_unused();
  EXPECT_EQ(store.statistics().resident_bytes, 0u);
}

}  // namespace
}  // namespace nacre
