#include "runtime/texture/tile_set.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>

#include "runtime/texture/texture_set.h"
#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

class TileSet : public testing::Test {
 protected:
  void touch(const std::string& name) { write_file(folder_.file(name), "x"); }

  /// "u,v u,v ..." in the order found, or the code of the complaint.
  std::string found(const std::string& pattern, const TileLimits& limits = {}) {
    Diagnostics diagnostics;
    const auto tiles = find_tiles(pattern, limits, diagnostics);
    if (!tiles) {
      EXPECT_EQ(diagnostics.error_count(), 1u);
      EXPECT_EQ(diagnostics.all()[0].where.file, pattern);
      return diagnostics.all()[0].code;
    }
    EXPECT_EQ(diagnostics.all().size(), 0u);
    std::string text;
    for (const TileFile& tile : *tiles) {
      EXPECT_TRUE(std::filesystem::exists(tile.path)) << tile.path;
      if (!text.empty()) text += ' ';
      text += std::to_string(tile.u) + "," + std::to_string(tile.v);
    }
    return text;
  }

  TemporaryFolder folder_;
};

TEST_F(TileSet, UdimNumbersCountTenColumns) {
  for (const char* name : {"a.1001.png", "a.1010.png", "a.1011.png", "a.1102.png"}) touch(name);
  EXPECT_EQ(found(folder_.file("a.<UDIM>.png")), "0,0 9,0 0,1 1,10");
}

TEST_F(TileSet, OnlyWholeNamesMatch) {
  for (const char* name :
       {"a.1001.png", "b.1001.png", "a.1002.png.bak", "a.999.png", "a.1000.png", "a.01003.png",
        "a.10040.png", "a.x005.png", "aa.1006.png", "a..png", "a.-101.png", "a.+101.png"}) {
    touch(name);
  }
  EXPECT_EQ(found(folder_.file("a.<UDIM>.png")), "0,0");
}

TEST_F(TileSet, UvTilesStartAtOneAndMayBeNegative) {
  for (const char* name :
       {"t_u1_v1.exr", "t_u2_v1.exr", "t_u0_v-2.exr", "t_u01_v1.exr", "t_u1_v.exr", "t_u_v1.exr"}) {
    touch(name);
  }
  EXPECT_EQ(found(folder_.file("t_<UVTILE>.exr")), "-1,-3 0,0 1,0");
}

TEST_F(TileSet, RepeatedTokenMeansTheSameTile) {
  touch("1001_a_1001.png");
  touch("1001_a_1002.png");
  EXPECT_EQ(found(folder_.file("<UDIM>_a_<UDIM>.png")), "0,0");
}

TEST_F(TileSet, DigitsMayFollowAUdim) {
  touch("a10012.png");
  touch("a10022.png");
  touch("a10023.png");
  EXPECT_EQ(found(folder_.file("a<UDIM>2.png")), "0,0 1,0");
}

TEST_F(TileSet, WrongPatternsAreSaid) {
  EXPECT_EQ(found(folder_.file("plain.png")), "bad-tile-pattern");
  EXPECT_EQ(found(folder_.file("<UDIM>.<UVTILE>.png")), "bad-tile-pattern");
  EXPECT_EQ(found(folder_.file("<UDIM>/a.<UDIM>.png")), "bad-tile-pattern");
  EXPECT_EQ(found(folder_.file("a.<UDIM>.png")), "missing-image");
  EXPECT_EQ(found(folder_.file("nowhere/a.<UDIM>.png")), "missing-image");
}

TEST_F(TileSet, LimitsHold) {
  for (int i = 0; i < 20; ++i) touch("a." + std::to_string(1001 + i) + ".png");
  EXPECT_EQ(found(folder_.file("a.<UDIM>.png"), {.max_folder_entries = 19}), "too-many-files");
  EXPECT_EQ(found(folder_.file("a.<UDIM>.png"), {.max_tiles = 19}), "too-many-files");
  EXPECT_EQ(found(folder_.file("a.<UDIM>.png"), {.max_cells = 19}), "too-many-files");
  EXPECT_NE(found(folder_.file("a.<UDIM>.png"), {20, 20, 20}), "too-many-files");
  touch("b_u1_v1.png");
  touch("b_u1000000_v1000000.png");
  touch("b_u2147483647_v-2147483648.png");
  EXPECT_EQ(found(folder_.file("b_<UVTILE>.png")), "too-many-files");
}

TEST_F(TileSet, DirectoryHoldsTheNumberOfEachCellsFile) {
  const std::vector<TileFile> tiles{{1, -1, "a"}, {3, -1, "b"}, {2, 0, "c"}};
  const auto words = tile_directory(tiles);
  ASSERT_EQ(words.size(), 16u + 3 * 2);
  EXPECT_EQ(words[0], tile_directory_magic);
  EXPECT_EQ(static_cast<int>(words[1]), 1);
  EXPECT_EQ(static_cast<int>(words[2]), -1);
  EXPECT_EQ(words[3], 3u);
  EXPECT_EQ(words[4], 2u);
  EXPECT_EQ(words[5], 3u);
  const std::vector<std::uint32_t> cells(words.begin() + 16, words.end());
  EXPECT_EQ(cells, (std::vector<std::uint32_t>{0, no_tile, 1, no_tile, 2, no_tile}));
}

TEST_F(TileSet, SetSharesTexturesAndReportsABrokenTile) {
  ASSERT_TRUE(write_image(folder_.file("a.1001.png"), random_image(4, 4, 3, 255, 1)));
  ASSERT_TRUE(write_image(folder_.file("a.1012.png"), random_image(8, 2, 3, 255, 2)));
  touch("a.1002.png");
  TextureStore store;
  Diagnostics diagnostics;
  const TextureSet set = acquire_set(store, {folder_.file("a.<UDIM>.png"), "", {}}, diagnostics);
  ASSERT_EQ(set.textures.size(), 3u);
  EXPECT_TRUE(set.textures[0]->resident());
  EXPECT_TRUE(set.textures[1]->missing());
  EXPECT_EQ(set.textures[2]->width(), 8);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].where.file, folder_.file("a.1002.png"));
  EXPECT_EQ(store.acquire({folder_.file("a.1012.png"), "", {}}, diagnostics), set.textures[2]);
}

TEST_F(TileSet, AllTilesOfAGridAreResident) {
  for (const int number : {1001, 1002, 1003, 1011, 1012, 1013}) {
    const std::string name = "grid." + std::to_string(number) + ".png";
    ASSERT_TRUE(write_image(folder_.file(name), random_image(4, 4, 3, 255, number)));
  }
  const std::string pattern = folder_.file("grid.<UDIM>.png");
  EXPECT_EQ(found(pattern), "0,0 1,0 2,0 0,1 1,1 2,1");
  TextureStore store;
  Diagnostics diagnostics;
  const TextureSet set = acquire_set(store, {pattern, "", {}}, diagnostics);
  EXPECT_EQ(set.textures.size(), 6u);
  EXPECT_EQ(store.statistics().resident_textures, 6u) << diagnostics.to_string();
}

}  // namespace
}  // namespace nacre
