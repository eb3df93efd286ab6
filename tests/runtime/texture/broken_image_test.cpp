#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "runtime/texture/texel.h"
#include "runtime/texture/texture_store.h"
#include "tests/runtime/texture/hostile_image.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

using namespace texture_layout;

class BrokenImage : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }
  TemporaryFolder folder_;
};

/// Either missing with one error that names the file, or a sound texture.
void expect_sound(const TextureHandle& texture, const Diagnostics& diagnostics,
                  const std::string& path) {
  if (texture->missing()) {
    ASSERT_EQ(diagnostics.error_count(), 1u);
    EXPECT_EQ(diagnostics.all()[0].where.file, path);
    return;
  }
  EXPECT_EQ(diagnostics.all().size(), 0u);
  const auto words = texture->words();
  ASSERT_EQ(words.size(), words[word_total_words]);
  const auto format = static_cast<TexelFormat>(words[word_format]);
  const Plan planned = plan(format, texture->width(), texture->height(), 4);
  for (int y = 0; y < texture->height(); ++y) {
    for (int x = 0; x < texture->width(); ++x) {
      for (const float value : decode_texel(format, &words[texel_index(planned, 0, x, y)])) {
        ASSERT_TRUE(std::isfinite(value));
      }
    }
  }
}

TEST_F(BrokenImage, TruncatedAtEveryKilobyteIsReportedOrSound) {
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  struct Case {
    const char* name;
    const char* type;
    /// Cut below this size it must be found out: after the pixels of a TGA comes a footer
    /// that nobody needs.
    std::size_t found_below;
  };
  for (const Case& one :
       {Case{"a.png", "uint8", all}, Case{"b.exr", "half", all}, Case{"c.tif", "float", all},
        Case{"d.jpg", "uint8", all}, Case{"e.tga", "uint8", 64 * 48 * 3},
        Case{"f.bmp", "uint8", all}, Case{"g.hdr", "float", all}}) {
    WriteOptions options;
    options.type = one.type;
    ASSERT_TRUE(write_image(file(one.name), random_image(64, 48, 3, 255), options)) << one.name;
    const std::string whole = read_file(file(one.name));
    for (std::size_t size = 0; size < whole.size(); size += size == 0 ? 20 : 1024) {
      const std::string path = file("cut" + std::to_string(size) + one.name);
      write_file(path, whole.substr(0, size));
      TextureStore store;
      Diagnostics diagnostics;
      const TextureHandle texture = store.acquire({path, "", {}}, diagnostics);
      expect_sound(texture, diagnostics, path);
      if (size < one.found_below) {
        EXPECT_TRUE(texture->missing()) << one.name << " cut to " << size;
      }
      EXPECT_EQ(store.statistics().resident_bytes,
                texture->missing() ? 0 : texture->words().size_bytes());
    }
  }
}

// OpenImageIO leaves libpng's own reporting on, which writes to stderr.
TEST_F(BrokenImage, DamagedPngIsNotPrintedAbout) {
  ASSERT_TRUE(write_image(file("a.png"), random_image(40, 30, 3, 255)));
  const std::string whole = read_file(file("a.png"));
  testing::internal::CaptureStderr();
  for (std::size_t at = 8; at < whole.size(); at += 7) {
    std::string bytes = whole;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x55);
    write_file(file("flipped.png"), bytes);
    write_file(file("cut.png"), whole.substr(0, at));
    TextureStore store;
    Diagnostics diagnostics;
    EXPECT_TRUE(store.acquire({file("flipped.png"), "", {}}, diagnostics)->missing());
    EXPECT_TRUE(store.acquire({file("cut.png"), "", {}}, diagnostics)->missing());
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(BrokenImage, FlippedBytesAreReportedOrSound) {
  for (const char* name : {"a.png", "b.exr", "c.tif", "d.jpg", "e.tga", "g.hdr"}) {
    WriteOptions options;
    if (name[2] == 'e' || name[2] == 'h') options.type = "float";
    ASSERT_TRUE(write_image(file(name), random_image(24, 16, 3, 255), options)) << name;
    const std::string whole = read_file(file(name));
    for (std::size_t at = 8; at < whole.size(); at += 1 + whole.size() / 150) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ 0xff);
      const std::string path = file(std::to_string(at) + name);
      write_file(path, bytes);
      TextureStore store;
      Diagnostics diagnostics;
      expect_sound(store.acquire({path, "", {}}, diagnostics), diagnostics, path);
    }
  }
}

TEST_F(BrokenImage, HeaderThatPromisesTooMuchIsRefusedBeforeAllocation) {
  write_file(file("large.tga"), tga_header(16384, 16384));
  write_file(file("huge.tga"), tga_header(65535, 65535));
  TextureStore store;
  Diagnostics diagnostics;
  EXPECT_TRUE(store.acquire({file("large.tga"), "", {}}, diagnostics)->missing());
  EXPECT_TRUE(store.acquire({file("huge.tga"), "", {}}, diagnostics)->missing());
  ASSERT_EQ(diagnostics.all().size(), 2u);
  EXPECT_EQ(diagnostics.all()[0].code, "broken-image");
  EXPECT_EQ(diagnostics.all()[1].code, "image-too-large");
  EXPECT_EQ(store.statistics().peak_resident_bytes, 0u);
}

TEST_F(BrokenImage, MissingFileIsSaidOnceAndTheTextureSaysMissing) {
  TextureStore store;
  Diagnostics diagnostics;
  const TextureKey key{file("nowhere.png"), "", {}};
  const TextureHandle texture = store.acquire(key, diagnostics);
  const TextureHandle again = store.acquire(key, diagnostics);
  EXPECT_EQ(texture, again);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "missing-image");
  EXPECT_EQ(diagnostics.all()[0].where.file, key.path);
  EXPECT_TRUE(texture->missing());
  EXPECT_FALSE(texture->resident());
  // A kernel that reads it all the same finds one texel of zero.
  const auto words = texture->words();
  EXPECT_EQ(words[word_flags], texture_missing);
  EXPECT_EQ(words[word_width], 1u);
  EXPECT_EQ(words[words[word_level_start]], 0u);
  EXPECT_EQ(store.statistics().missing_textures, 1u);
}

TEST_F(BrokenImage, AnotherCompilationHearsOfTheSameProblem) {
  TextureStore store;
  Diagnostics first;
  Diagnostics second;
  const TextureKey key{file("nowhere.png"), "", {}};
  const TextureHandle held = store.acquire(key, first);
  store.acquire(key, second);
  EXPECT_EQ(second.all().size(), 1u);
}

TEST_F(BrokenImage, FileThatAppearsLaterIsFound) {
  TextureStore store;
  Diagnostics diagnostics;
  const TextureKey key{file("late.png"), "", {}};
  EXPECT_TRUE(store.acquire(key, diagnostics)->missing());
  ASSERT_TRUE(write_image(key.path, random_image(4, 4, 3, 255)));
  EXPECT_TRUE(store.acquire(key, diagnostics)->resident());
}

}  // namespace
}  // namespace nacre
