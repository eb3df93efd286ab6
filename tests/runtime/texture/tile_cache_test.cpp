#include "runtime/texture/tile_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/runtime/texture/test_image.h"

namespace nacre {
namespace {

constexpr int side = 300, tile = 64;

/// Their readers can go forwards only, and begin again for an earlier row. What they then
/// read must be what was looked at, not what the name means by now.
TEST(TileCacheTest, AnEarlierRowIsOfTheSameFile) {
  const TemporaryFolder folder;
  for (const std::string name : {"a.png", "a.jpg", "a.bmp", "a.gif", "a.tga"}) {
    const std::string path = folder.file(name);
    ASSERT_TRUE(write_image(path, random_image(side, side, 3, 255)));
    ImageReader reader;
    ASSERT_FALSE(reader.open(path, "", {})) << name;
    const auto row = static_cast<std::size_t>(side * reader.info().channels);
    std::vector<float> all;
    ASSERT_FALSE(reader.read(
        [&](int, const float* samples) { all.insert(all.end(), samples, samples + row); }));
    const auto cache = TileCache::make(std::uint64_t{16} << 20, {});
    ASSERT_NE(cache, nullptr);
    const auto file = cache->open(path, reader.info());
    ASSERT_NE(file, nullptr) << name;
    std::vector<float> tiles(tile * row);
    ASSERT_TRUE(cache->read(*file, 0, 0, side, side - tile, side, tiles.data())) << name;
    EXPECT_TRUE(std::equal(tiles.begin(), tiles.end(), all.end() - tile * row)) << name;
    write_file(path, "something else");
    ASSERT_TRUE(cache->read(*file, 0, 0, side, 0, tile, tiles.data())) << name;
    EXPECT_TRUE(std::equal(tiles.begin(), tiles.end(), all.begin())) << name;
  }
}

}  // namespace
}  // namespace nacre
