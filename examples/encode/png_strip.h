#pragma once

#include <cstdint>
#include <vector>

namespace nacre::host {

/// Rows of a PNG, compressed by themselves: a piece of the image's one zlib stream that refers
/// to nothing before it. (libpng compresses rows one after another.)
struct PngStrip {
  std::vector<unsigned char> deflated;
  std::uint32_t checksum = 1;   ///< Adler-32 of the filtered rows.
  std::uint64_t raw_bytes = 0;  ///< Of the filtered rows.
};

/// Filters rows of `row_bytes` each, whose texels have `texel_bytes`, and compresses them.
/// Each byte has that of the texel on its left subtracted, the filter that needs no row above.
/// `is_last`: the stream ends with it.
PngStrip compress_strip(const std::vector<unsigned char>& rows, std::size_t row_bytes,
                        std::size_t texel_bytes, bool is_last);

/// A chunk as a file has it: length, four letters, data and CRC.
std::vector<unsigned char> png_chunk(const char* letters, const std::vector<unsigned char>& data);

/// The Adler-32 of two parts, of which the second has so many bytes.
std::uint32_t joined_checksum(std::uint32_t first, std::uint32_t second, std::uint64_t bytes);

/// Highest byte first, as PNG has all numbers.
void append_big_endian(std::vector<unsigned char>& bytes, std::uint32_t value);

}  // namespace nacre::host
