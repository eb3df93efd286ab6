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

/// A PNG's signature and IHDR.
struct PngFields {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  int depth = 8;
  int color_type = 0;
  int compression = 0;
  int filter = 0;
  int interlacing = 0;
};
std::string png_start(const PngFields& fields);
std::string png_chunk(const std::string& type, const std::string& data);
/// A zlib stream of those bytes as they are.
std::string zlib_stored(const std::string& bytes);

/// A PNG of 8-bit grey whose data, of `packed` bytes, are nothing that can be unpacked; the
/// checksums are right.
std::string png_of_noise(std::uint32_t width, std::uint32_t height, std::size_t packed);

/// An uncompressed or packed TGA header of 18 bytes that promises any size.
std::string tga_header(int width, int height, int kind = 2, int bits = 24);

/// What a BMP's headers say; Windows' third version unless it has another size.
struct BmpFields {
  std::uint32_t pixels_at = 0;  ///< 0: where they are.
  std::uint32_t header_size = 40;
  std::int32_t width = 1;
  std::int32_t height = 1;
  std::uint32_t bits = 24;
  std::uint32_t packing = 0;
  std::uint32_t colors = 0;
  std::vector<std::uint32_t> masks = {};  ///< In the header, or behind a short one.
};
std::string bmp(const BmpFields& fields, const std::string& pixels,
                const std::string& palette = "");

/// A GIF's header and logical screen descriptor, and a table of 2, 4, ... 256 colours or none.
std::string gif_start(int width, int height, const std::string& table = "");

struct GifFrame {
  int left = 0;
  int top = 0;
  int width = 1;
  int height = 1;
  bool is_interlaced = false;
  int code_size = 8;
  std::string table = {};  ///< Of its own, if any.
};
/// An image descriptor and codes for `pixels`, numbers of colours.
std::string gif_frame(const GifFrame& frame, const std::string& pixels);

/// The extension that makes a colour transparent.
std::string gif_transparency(int color);

}  // namespace nacre
