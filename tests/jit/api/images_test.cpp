// Images that a host has in memory, or looks up itself.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <nacre/nacre.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/jit/api/image_points.h"

namespace nacre {
namespace {

template <class T>
Image row_of(const std::vector<T>& samples, int channels, int type) {
  return {static_cast<int>(samples.size()) / channels, 1, channels, type, samples.data(), 0};
}

TEST(ApiImages, AnImageInMemoryIsReplacedUnderShaders) {
  System system;
  const std::vector<std::uint8_t> first{255, 0, 0, 0, 0, 255};
  system.set_image("painted", row_of(first, 3, NACRE_UINT8));
  const Shader shader = system.compile_outputs(image_document("painted"), {"out"});
  EXPECT_EQ(colors_at(shader, {0.25f, 0.75f}), (std::vector<Color>{red, blue}));
  const std::uint64_t bytes = system.texture_statistics().resident_bytes;
  EXPECT_EQ(system.texture_statistics().resident_textures, 1u);

  // Of another size, and with samples that are kept as the first ones are: in eight bits.
  const std::vector<float> second{0, 1, 0, 1, 0, 0, 0, 0, 0.21f, 2, 0, 0};
  system.set_image("painted", row_of(second, 3, NACRE_FLOAT32));
  EXPECT_EQ(colors_at(shader, {0.125f, 0.375f, 0.875f}), (std::vector<Color>{green, red, red}));
  EXPECT_FLOAT_EQ(colors_at(shader, {0.625f})[0][2], 54.0f / 255.0f);

  const std::vector<std::uint8_t> grey{1, 2, 3};
  EXPECT_THROW(system.set_image("painted", row_of(grey, 1, NACRE_UINT8)), Error);
  EXPECT_EQ(colors_at(shader, {0.125f}), std::vector<Color>{green});
  system.set_image("painted", row_of(first, 3, NACRE_UINT8));
  EXPECT_EQ(system.texture_statistics().resident_bytes, bytes);

  system.remove_image("painted");
  EXPECT_EQ(system.texture_statistics().resident_bytes, 0u);
  EXPECT_EQ(colors_at(shader, {0.25f}), std::vector<Color>{red});
  EXPECT_THROW(system.compile_outputs(image_document("painted"), {"out"}), Error);
}

TEST(ApiImages, EveryKindOfSampleAndRowsOfAnyLength) {
  System system;
  const std::uint16_t words[] = {65535, 0, 0, 0, 0, 65535};
  system.set_image("words", {2, 1, 3, NACRE_UINT16, words, 0});
  const std::uint16_t halves[] = {0x3c00, 0, 0, 0, 0, 0x3800};  // 1 and 1/2.
  system.set_image("halves", {2, 1, 3, NACRE_HALF, halves, 0});
  // Two rows; the bottom one first, eight samples apart. v = 1/2 is the upper one's lowest edge.
  const float rows[] = {0, 1, 0, 0, 1, 0, 9, 9, 1, 0, 0, 0, 0, 1, 9, 9};
  system.set_image("rows", {2, 2, 3, NACRE_FLOAT32, rows + 8, -32});
  const auto shown = [&](const char* name) {
    return colors_at(system.compile_outputs(image_document(name), {"out"}), {0.25f, 0.75f});
  };
  EXPECT_EQ(shown("words"), (std::vector<Color>{red, blue}));
  EXPECT_EQ(shown("halves"), (std::vector<Color>{red, {0, 0, 0.5f}}));
  EXPECT_EQ(shown("rows"), (std::vector<Color>{red, blue}));
}

TEST(ApiImages, WhatCannotBeMeantIsRefused) {
  System system;
  const float pixel[4] = {};
  EXPECT_THROW(system.set_image("x", {0, 1, 3, NACRE_FLOAT32, pixel, 0}), Error);
  EXPECT_THROW(system.set_image("x", {1, 1, 5, NACRE_FLOAT32, pixel, 0}), Error);
  EXPECT_THROW(system.set_image("x", {1, 1, 3, 4, pixel, 0}), Error);
  EXPECT_THROW(system.set_image("x", {1, 1, 3, NACRE_FLOAT32, nullptr, 0}), Error);
  EXPECT_THROW(system.set_image("x", {20000, 1, 1, NACRE_UINT8, pixel, 0}), Error);
  EXPECT_THROW(system.set_image("", {1, 1, 3, NACRE_FLOAT32, pixel, 0}), Error);
  SystemOptions small;
  small.texture_memory = 1000;
  const std::vector<float> large(300);
  EXPECT_THROW(System(small).set_image("x", row_of(large, 3, NACRE_FLOAT32)), Error);
}

TEST(ApiImages, ABatchReadsOneImage) {
  System system;
  const std::vector<std::uint8_t> images[] = {{255, 0, 0, 255, 0, 0}, {0, 0, 255, 0, 0, 255}};
  system.set_image("flip", row_of(images[0], 3, NACRE_UINT8));
  const Shader shader = system.compile_outputs(image_document("flip"), {"out"});
  std::atomic<bool> is_over = false;
  std::thread painter([&] {
    for (int i = 0; !is_over; ++i) system.set_image("flip", row_of(images[i & 1], 3, NACRE_UINT8));
  });
  const std::vector<float> places(1000, 0.3f);
  for (int round = 0; round < 100; ++round) {
    const std::vector<Color> seen = colors_at(shader, places);
    ASSERT_TRUE(seen[0] == red || seen[0] == blue);
    ASSERT_EQ(seen, std::vector<Color>(places.size(), seen[0]));
  }
  is_over = true;
  painter.join();
}

/// Its red is u, its green the filter, its blue is no number.
class Coordinates : public HostImage {
 public:
  explicit Coordinates(int& alive) : alive_(alive) { ++alive_; }
  ~Coordinates() override { --alive_; }
  int width() const override { return 640; }
  int height() const override { return 480; }
  void look_up(const nacre_texture_lookup& lookup, float* const* rgba) const noexcept override {
    for (int i = 0; i < lookup.count; ++i) {
      rgba[0][i] = lookup.u[i];
      rgba[1][i] = static_cast<float>(lookup.filter);
      rgba[2][i] = std::numeric_limits<float>::quiet_NaN();
      rgba[3][i] = 1;
    }
  }

 private:
  int& alive_;
};

TEST(ApiImages, ATextureSystemLooksUp) {
  int alive = 0;
  std::vector<std::string> opened;
  {
    SystemOptions options;
    options.textures = [&](const std::string& name,
                           const std::string&) -> std::unique_ptr<HostImage> {
      opened.push_back(name);
      if (name.find(".ptex") == std::string::npos) return nullptr;
      return std::make_unique<Coordinates>(alive);
    };
    System system(options);
    for (const int engine : {NACRE_JIT, NACRE_INTERPRETER, NACRE_REFERENCE}) {
      CompileOptions how;
      how.engine = engine;
      const Shader shader =
          system.compile_outputs(image_document("skin.ptex", "image.mtlx", "cubic"), {"out"}, how);
      EXPECT_EQ(alive, 1);
      EXPECT_EQ(colors_at(shader, {0.25f, 0.75f}),
                (std::vector<Color>{{0.25f, NACRE_CUBIC, 0}, {0.75f, NACRE_CUBIC, 0}}));
    }
    EXPECT_EQ(alive, 0);
    EXPECT_THROW(system.compile_outputs(image_document("nowhere.tga"), {"out"}), Error);
  }
  EXPECT_EQ(opened,
            (std::vector<std::string>{"skin.ptex", "skin.ptex", "skin.ptex", "nowhere.tga"}));
}

/// Counts what it gives.
class CountingMemory : public std::pmr::memory_resource {
 public:
  std::size_t in_use = 0, most = 0;

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    most = std::max(most, in_use += bytes);
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override {
    in_use -= bytes;
    std::pmr::new_delete_resource()->deallocate(block, bytes, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

TEST(ApiImages, TexelsLieInTheHostsMemory) {
  CountingMemory memory;
  {
    SystemOptions options;
    options.memory = &memory;
    System system(options);
    const std::vector<float> pixels(3 * 1000, 0.5f);
    system.set_image("x", row_of(pixels, 3, NACRE_FLOAT32));
    EXPECT_EQ(memory.in_use, system.texture_statistics().resident_bytes);
    EXPECT_GE(memory.in_use, 1000u * 16);
  }
  EXPECT_EQ(memory.in_use, 0u);
}

}  // namespace
}  // namespace nacre
