#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "runtime/texture/essential_image.h"
#include "runtime/texture/png_data.h"

namespace nacre {

namespace {

constexpr std::size_t signature_size = 8;
constexpr std::uint64_t frame_size = 12;  // Length, type and checksum around the data.
constexpr std::uint32_t most_of_palette = 768;
constexpr std::array<std::string_view, 5> needed{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};

/// ISO 3309 CRC-32 (PNG, annex D) of what `crc` is of and more.
std::uint32_t continue_crc(std::uint32_t crc, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      ::crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

/// Four bytes, the most significant first.
std::uint32_t number(std::string_view bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// More than the pixels of such a header can be packed into, by any encoder that tries.
std::uint64_t most_packed_bytes(const PngHeader& header) {
  const std::uint64_t pixel_bytes = header.depth > 8 ? 8 : 4;
  return 2 * pixel_bytes * (header.width + std::uint64_t{16}) * header.height +
         (std::uint64_t{1} << 20);
}

class PngReader {
 public:
  PngReader(const ImageFile& file, const ImageLimits& limits, ImageExtent extent,
            std::string& bytes)
      : file_(file), limits_(limits), extent_(extent), cursor_(file), bytes_(bytes) {}

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
      const bool is_data = type == "IDAT";
      // As far as libpng reads before it is asked for pixels.
      if (is_data && extent_ == ImageExtent::header) {
        bytes_ += head;
        return std::nullopt;
      }
      // What comes behind the first pixels says nothing about them any more.
      const bool is_late = data_ && (type == "PLTE" || type == "tRNS");
      const bool is_needed =
          !is_late && std::find(needed.begin(), needed.end(), type) != needed.end();
      if (is_data && !data_) data_.emplace(*header_);
      const std::size_t start = bytes_.size();
      if (is_needed) bytes_ += head;
      std::uint32_t crc = continue_crc(0, type);
      for (std::uint32_t left = number(head); left > 0;) {
        const std::uint32_t count = std::min(left, 1u << 16);
        if (!cursor_.take(count, piece)) return broken("the file ends inside a chunk");
        crc = continue_crc(crc, piece);
        if (is_needed) bytes_ += piece;
        if (is_data && !data_->take(piece)) return broken("the pixels are damaged");
        left -= count;
      }
      if (!cursor_.take(4, sum) || crc != number(sum)) {
        return broken("a chunk has the wrong checksum");
      }
      if (is_needed) bytes_ += sum;
      if (is_first) {
        header_.emplace(std::string_view(bytes_).substr(start + 8, 13));
        if (auto problem = check_header()) return problem;
      }
      if (type != "IEND") continue;
      if (!data_ || !data_->is_whole()) return broken("the file ends before the image does");
      return std::nullopt;
    }
  }

 private:
  std::optional<Diagnostic> broken(std::string reason) const {
    return broken_image(file_.path(), std::move(reason));
  }

  /// Before anything is unpacked. Transparency may add a channel, which the reader counts.
  std::optional<Diagnostic> check_header() const {
    const PngHeader& header = *header_;
    if (auto problem = check_image_size(file_.path(), header.width, header.height, limits_)) {
      return problem;
    }
    if (!header.is_valid()) return broken("the header makes no sense");
    const std::uint64_t pixels = std::uint64_t{header.width} * header.height;
    const std::uint64_t channels = header.has_palette() ? 3 : header.samples();
    const std::uint64_t sample = header.depth == 16 ? 2 : 1;
    const std::uint64_t bytes = pixels * channels * sample;
    return check_image_bytes(
        file_,
        {.decoded = bytes, .kept = bytes, .in_memory = pixels * 4 * (channels == 1 ? 1 : sample)},
        limits_);
  }

  /// A chunk's place, and its length against what it may hold.
  std::optional<Diagnostic> check_chunk(std::string_view head, std::string_view type) {
    const std::uint32_t length = number(head);
    if (type == "IHDR" && length != 13) return broken("IHDR has the wrong length");
    if ((type == "PLTE" || type == "tRNS") && length > most_of_palette) {
      return broken("the palette is too long");
    }
    if (type == "PLTE" && !data_) {
      if (has_palette_) return broken("there are two palettes");
      if (length == 0 || length % 3 != 0) return broken("the palette has the wrong length");
      has_palette_ = true;
    }
    if (type != "IDAT") return std::nullopt;
    if (header_->has_palette() && !has_palette_) return broken("there is no palette");
    packed_ += length;
    if (packed_ > most_packed_bytes(*header_)) {
      return broken("there is more data than the pixels need");
    }
    return std::nullopt;
  }

  const ImageFile& file_;
  const ImageLimits& limits_;
  ImageExtent extent_;
  FileCursor cursor_;
  std::string& bytes_;
  std::optional<PngHeader> header_;
  std::optional<PngData> data_;  ///< From the first chunk of them.
  bool has_palette_ = false;
  std::uint64_t packed_ = 0;
};

}  // namespace

std::optional<Diagnostic> essential_png(const ImageFile& file, const ImageLimits& limits,
                                        ImageExtent extent, std::string& bytes) {
  return PngReader(file, limits, extent, bytes).run();
}

}  // namespace nacre
