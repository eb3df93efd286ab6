#include "runtime/texture/bmp_runs.h"

#include "runtime/texture/little_endian.h"

namespace nacre {

namespace {

constexpr std::uint32_t end_of_line = 0, end_of_bitmap = 1, offset = 2;  // After a zero.

char color_of(std::string_view bytes, std::size_t pixel, bool is_nibbles) {
  if (!is_nibbles) return bytes[pixel];
  const std::uint32_t both = byte_at(bytes, pixel / 2);
  return static_cast<char>(pixel % 2 == 0 ? both >> 4 : both & 15u);
}

}  // namespace

std::optional<std::string> write_out_bmp_runs(FileCursor& cursor, const BmpRuns& runs,
                                              char* pixels) {
  const std::uint64_t row = (runs.width + 3) / 4 * 4;
  std::uint64_t x = 0, y = 0;
  /// Pixels past the end of a line are no pixels.
  const auto put = [&](char color) {
    if (x < runs.width) pixels[y * row + x] = color;
    ++x;
  };
  // A run for each pixel, an end for each line, and some that do nothing.
  const std::uint64_t most = cursor.at() + 4 * (runs.width + 4) * runs.height + (1u << 16);
  for (std::string pair, more;;) {
    if (!cursor.take(2, pair)) return "the file ends before the image does";
    if (cursor.at() > most) return "there is more data than the pixels need";
    const std::uint32_t count = byte_at(pair, 0), value = byte_at(pair, 1);
    if (count == 0 && value == end_of_bitmap) return std::nullopt;
    if (y >= runs.height) return "there are more rows than the image has";
    if (count > 0) {
      const char both[] = {pair[1], pair[1]};
      for (std::uint32_t i = 0; i < count; ++i) put(color_of({both, 2}, i % 2, runs.is_nibbles));
    } else if (value == end_of_line) {
      x = 0;
      ++y;
    } else if (value == offset) {
      if (!cursor.take(2, more)) return "the file ends before the image does";
      x += byte_at(more, 0);
      y += byte_at(more, 1);
    } else {
      // Pixels one by one, padded to two bytes.
      const std::uint32_t bytes = runs.is_nibbles ? (value + 1) / 2 : value;
      if (!cursor.take(bytes + bytes % 2, more)) return "the file ends before the image does";
      for (std::uint32_t i = 0; i < value; ++i) put(color_of(more, i, runs.is_nibbles));
    }
  }
}

}  // namespace nacre
