#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "runtime/texture/essential_image.h"

namespace nacre {

namespace {

constexpr std::size_t signature_size = 8;
constexpr std::uint64_t frame_size = 12;  // Length, type and checksum around the data.
constexpr std::uint32_t most_of_palette = 768;
constexpr std::array<std::string_view, 5> needed{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};

/// ISO 3309 CRC-32, reflected; PNG Specification, annex D.
constexpr std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1u) ? 0xedb88320u ^ c >> 1 : c >> 1;
    table[n] = c;
  }
  return table;
}

std::uint32_t continue_crc(std::uint32_t c, std::string_view bytes) {
  static constexpr auto table = make_crc_table();
  for (const char byte : bytes) c = table[(c ^ static_cast<unsigned char>(byte)) & 0xffu] ^ c >> 8;
  return c;
}

/// Four bytes, the most significant first.
std::uint32_t number(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// More than the pixels of such a header can be packed into, by any encoder that tries.
std::uint64_t most_packed_bytes(std::string_view header) {
  const auto bits = static_cast<unsigned char>(header[8]);
  const std::uint64_t pixel_bytes = bits > 8 ? 8 : 4;
  return 2 * pixel_bytes * (number(header) + std::uint64_t{16}) * number(header.substr(4)) +
         (std::uint64_t{1} << 20);
}

class PngReader {
 public:
  PngReader(const ImageFile& file, const ImageLimits& limits, std::string& bytes)
      : file_(file), limits_(limits), cursor_(file), bytes_(bytes) {}

  std::optional<Diagnostic> run() {
    if (!cursor_.take(signature_size, bytes_)) return broken("the file ends inside its signature");
    for (bool is_first = true;; is_first = false) {
      std::string head, piece, sum;
      if (!cursor_.take(8, head) || cursor_.left() < frame_size - 8 ||
          cursor_.left() - (frame_size - 8) < number(head)) {
        return broken("the file ends inside a chunk");
      }
      const std::string_view type = std::string_view(head).substr(4);
      if (is_first != (type == "IHDR")) {
        return broken("the first chunk, and no other, must be IHDR");
      }
      if (auto problem = check_chunk(head, type)) return problem;
      const bool is_needed = std::find(needed.begin(), needed.end(), type) != needed.end();
      const std::size_t start = bytes_.size();
      if (is_needed) bytes_ += head;
      std::uint32_t crc = continue_crc(0xffffffffu, type);
      for (std::uint32_t left = number(head); left > 0;) {
        const std::uint32_t count = std::min(left, 1u << 16);
        if (!cursor_.take(count, piece)) return broken("the file ends inside a chunk");
        crc = continue_crc(crc, piece);
        if (is_needed) bytes_ += piece;
        left -= count;
      }
      if (!cursor_.take(4, sum) || ~crc != number(sum)) {
        return broken("a chunk has the wrong checksum");
      }
      if (is_needed) bytes_ += sum;
      if (is_first) {
        header_ = bytes_.substr(start + 8, 13);
        if (auto problem = check_image_size(file_.path(), number(header_),
                                            number(std::string_view(header_).substr(4)), limits_)) {
          return problem;
        }
      }
      if (type == "IEND") return std::nullopt;
    }
  }

 private:
  std::optional<Diagnostic> broken(std::string reason) const {
    return broken_image(file_.path(), std::move(reason));
  }

  /// The length of a chunk against what it may hold.
  std::optional<Diagnostic> check_chunk(std::string_view head, std::string_view type) {
    const std::uint32_t length = number(head);
    if (type == "IHDR" && length != 13) return broken("IHDR has the wrong length");
    if ((type == "PLTE" || type == "tRNS") && length > most_of_palette) {
      return broken("the palette is too long");
    }
    if (type == "IDAT") packed_ += length;
    if (packed_ > 0 && packed_ > most_packed_bytes(header_)) {
      return broken("there is more data than the pixels need");
    }
    return std::nullopt;
  }

  const ImageFile& file_;
  const ImageLimits& limits_;
  FileCursor cursor_;
  std::string& bytes_;
  std::string header_;
  std::uint64_t packed_ = 0;
};

}  // namespace

std::optional<Diagnostic> essential_png(const ImageFile& file, const ImageLimits& limits,
                                        std::string& bytes) {
  return PngReader(file, limits, bytes).run();
}

}  // namespace nacre
