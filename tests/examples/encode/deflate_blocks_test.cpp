// Pieces of a deflate stream by libdeflate, put together and unpacked by zlib.
#include "examples/encode/deflate_blocks.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

namespace nacre::host {
namespace {

using Bytes = std::vector<unsigned char>;

/// What zlib makes of a whole raw stream; empty if it is not one, or more follows.
Bytes inflated(const Bytes& stream, std::size_t size) {
  Bytes out(size + 1);
  z_stream z{};
  EXPECT_EQ(inflateInit2(&z, -MAX_WBITS), Z_OK);
  z.next_in = const_cast<Bytef*>(stream.data());
  z.avail_in = static_cast<uInt>(stream.size());
  z.next_out = out.data();
  z.avail_out = static_cast<uInt>(out.size());
  const bool is_whole = inflate(&z, Z_FINISH) == Z_STREAM_END && z.avail_in == 0;
  out.resize(is_whole ? z.total_out : 0);
  inflateEnd(&z);
  return out;
}

/// From all alike, 0, to noise, 255.
Bytes bytes_of(std::size_t size, int most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> any(0, most);
  Bytes bytes(size);
  for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(any(random));
  return bytes;
}

// The last byte of a block has any number of bits left, and each must be found.
TEST(DeflateBlocksTest, PiecesAreOneStream) {
  DeflateBlocks blocks;
  Bytes stream, all;
  unsigned seed = 0;
  for (const int most : {0, 1, 3, 20, 90, 255}) {
    for (const std::size_t size :
         {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{77}, std::size_t{1000},
          std::size_t{5001}, std::size_t{12289}, DeflateBlocks::block_bytes}) {
      for (int again = 0; again < 5; ++again) {
        const Bytes bytes = bytes_of(size, most, ++seed);
        ASSERT_TRUE(blocks.add(bytes, false, stream)) << most << ' ' << size;
        all.insert(all.end(), bytes.begin(), bytes.end());
      }
    }
  }
  const Bytes bytes = bytes_of(4000, 30, 0);
  all.insert(all.end(), bytes.begin(), bytes.end());
  ASSERT_TRUE(blocks.add(bytes, true, stream));
  EXPECT_EQ(inflated(stream, all.size()), all);
}

TEST(DeflateBlocksTest, SeveralBlocksAreRefused) {
  DeflateBlocks blocks;
  Bytes stream{1, 2, 3};
  EXPECT_FALSE(blocks.add(bytes_of(std::size_t{1} << 20, 90, 1), false, stream));
  EXPECT_EQ(stream, (Bytes{1, 2, 3}));
}

}  // namespace
}  // namespace nacre::host
