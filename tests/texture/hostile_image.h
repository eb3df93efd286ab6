#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nacre {

// Image files written byte by byte, so that they can also be written wrongly.

/// One entry of a TIFF directory; `text` is written behind the pixels where it is given.
struct TiffEntry {
  int tag = 0;
  int type = 4;  ///< 3: 16 bits, 4: 32 bits, 7: bytes.
  std::uint32_t count = 1;
  std::uint32_t value = 0;
  std::string text = {};
};

/// One uncompressed strip of 8-bit grey, width times height, with entries replaced or
/// added; the next directory is at `next`.
std::string tiff(std::uint32_t width, std::uint32_t height, const std::vector<TiffEntry>& more = {},
                 std::uint32_t next = 0);

/// A PNG of 8-bit grey whose data, of `packed` bytes, are nothing that can be unpacked; the
/// checksums are right.
std::string png_of_noise(std::uint32_t width, std::uint32_t height, std::size_t packed);

/// An uncompressed or packed TGA header of 18 bytes that promises any size.
std::string tga_header(int width, int height, int kind = 2, int bits = 24);

}  // namespace nacre
