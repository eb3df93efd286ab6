#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdlib>

#include "runtime/texture/bmp_runs.h"
#include "runtime/texture/essential_image.h"
#include "runtime/texture/little_endian.h"

namespace nacre {

namespace {

// Microsoft, "Bitmap Storage": BITMAPFILEHEADER and what follows it.
constexpr std::uint32_t file_header_size = 14;
constexpr std::uint32_t core_header = 12, info_header = 40;
constexpr std::uint32_t masks_end = 66;  // Of red, green and blue, in every longer header.
constexpr std::uint32_t unpacked = 0, runs_of_8 = 1, runs_of_4 = 2, bit_fields = 3;

/// What the headers say.
struct Bitmap {
  std::int64_t width = 0;
  std::int64_t height = 0;
  bool is_top_down = false;
  std::uint32_t bits = 0;  ///< Of a pixel.
  std::uint32_t packing = unpacked;
  std::uint32_t colors = 0;  ///< In the palette.
  std::uint64_t pixels_at = 0;
  std::array<std::uint32_t, 3> masks{};  ///< Of red, green and blue, where packing is bit_fields.

  bool has_runs() const { return packing == runs_of_8 || packing == runs_of_4; }
  std::uint64_t row_bytes() const {
    return (static_cast<std::uint64_t>(width) * bits + 31) / 32 * 4;
  }
};

bool is_one_run(std::uint32_t mask) {
  return mask != 0 && std::has_single_bit((mask >> std::countr_zero(mask)) + std::uint64_t{1});
}

class BmpReader {
 public:
  BmpReader(const ImageFile& file, const ImageLimits& limits, ImageExtent extent,
            std::string& bytes)
      : file_(file), limits_(limits), extent_(extent), cursor_(file), result_(bytes) {}

  std::optional<Diagnostic> run() {
    if (auto problem = take_header()) return problem;
    if (auto problem = check_packing()) return problem;
    if (auto problem = take_palette()) return problem;
    if (bitmap_.pixels_at > file_.bytes()) return broken("the pixels are behind the file's end");
    if (extent_ == ImageExtent::header) {
      begin_result(bitmap_.has_runs() ? 8 : bitmap_.bits, 0);
      return std::nullopt;
    }
    cursor_.skip(bitmap_.pixels_at - cursor_.at());
    return bitmap_.has_runs() ? take_runs() : take_rows();
  }

 private:
  std::optional<Diagnostic> broken(std::string reason) const {
    return broken_image(file_.path(), std::move(reason));
  }

  std::optional<Diagnostic> take_header() {
    std::string start, rest;
    if (!cursor_.take(file_header_size + 4, start)) {
      return broken("the file ends inside its header");
    }
    header_size_ = four_bytes_at(start, file_header_size);
    if (!is_bmp_header_size(header_size_) || !cursor_.take(header_size_ - 4, rest)) {
      return broken("the file ends inside its header");
    }
    std::string header = start + rest;
    bitmap_.pixels_at = four_bytes_at(header, 10);
    const bool is_core = header_size_ == core_header;
    std::int64_t height = 0;
    if (is_core) {
      bitmap_.width = two_bytes_at(header, 18);
      height = two_bytes_at(header, 20);
      bitmap_.bits = two_bytes_at(header, 24);
    } else {
      bitmap_.width = static_cast<std::int32_t>(four_bytes_at(header, 18));
      height = static_cast<std::int32_t>(four_bytes_at(header, 22));
      bitmap_.bits = two_bytes_at(header, 28);
      bitmap_.packing = four_bytes_at(header, 30);
      bitmap_.colors = four_bytes_at(header, 46);
    }
    bitmap_.is_top_down = height < 0;
    bitmap_.height = std::abs(height);
    if (bitmap_.packing == bit_fields) {
      if (header_size_ == info_header) {  // They follow it.
        if (!cursor_.take(12, rest)) return broken("the file ends inside its header");
        header += rest;
      }
      for (std::size_t i = 0; i < 3; ++i) {
        bitmap_.masks[i] = four_bytes_at(header, masks_end - 12 + 4 * i);
      }
    }
    return check_image_size(file_.path(), bitmap_.width, bitmap_.height, limits_);
  }

  std::optional<Diagnostic> unsupported(std::string found) const {
    return image_error("unsupported-image", file_.path(),
                       "the pixels are packed in a way that is not read",
                       "1, 4, 8, 16, 24 or 32 bits, plain, in runs, or with masks of 16 bits or of "
                       "the usual bytes",
                       std::move(found));
  }

  /// The pairs of depth and packing that the documentation of biCompression has, without
  /// the ones for printers.
  std::optional<Diagnostic> check_packing() const {
    constexpr std::array<std::uint32_t, 6> depths{1, 4, 8, 16, 24, 32};
    const Bitmap& b = bitmap_;
    if (std::find(depths.begin(), depths.end(), b.bits) == depths.end()) {
      return unsupported(fmt::format("{} bits", b.bits));
    }
    if (b.packing > bit_fields) return unsupported(fmt::format("method {}", b.packing));
    if ((b.packing == runs_of_8 && b.bits != 8) || (b.packing == runs_of_4 && b.bits != 4) ||
        (b.packing == bit_fields && b.bits != 16 && b.bits != 32)) {
      return broken("the pixels have a depth that does not go with their packing");
    }
    if (b.has_runs() && b.is_top_down) return broken("packed rows go from the bottom to the top");
    if (b.packing != bit_fields) return std::nullopt;
    if (b.bits == 32) {
      const bool is_usual = b.masks == std::array{0xff0000u, 0xff00u, 0xffu};
      return is_usual ? std::nullopt : unsupported("other masks");
    }
    // The reader counts the bits of each.
    std::uint32_t all = 0;
    for (const std::uint32_t mask : b.masks) {
      if (!is_one_run(mask) || mask > 0xffff || (mask & all) != 0) {
        return broken("a mask of a colour is impossible");
      }
      all |= mask;
    }
    return std::nullopt;
  }

  /// Between the headers and the pixels, in entries of four bytes. A count of none means as
  /// many colours as there can be; of the oldest header, which has no count, as many as
  /// there is room for.
  std::optional<Diagnostic> take_palette() {
    if (bitmap_.bits > 8) {
      bitmap_.colors = 0;
      return cursor_.at() <= bitmap_.pixels_at ? std::nullopt
                                               : broken("the pixels begin inside the header");
    }
    const std::uint32_t entry = header_size_ == core_header ? 3 : 4;
    const std::uint64_t room =
        bitmap_.pixels_at > cursor_.at() ? (bitmap_.pixels_at - cursor_.at()) / entry : 0;
    const std::uint32_t most = 1u << bitmap_.bits;
    if (bitmap_.colors == 0) {
      bitmap_.colors =
          entry == 3 ? static_cast<std::uint32_t>(std::min<std::uint64_t>(room, most)) : most;
    }
    if (bitmap_.colors == 0 || bitmap_.colors > most || bitmap_.colors > room) {
      return broken("the palette is not between the header and the pixels");
    }
    std::string color;
    for (std::uint32_t i = 0; i < bitmap_.colors; ++i) {
      if (!cursor_.take(entry, color)) return broken("the file ends inside its palette");
      palette_.append(color, 0, 3);
      palette_ += '\0';
    }
    return std::nullopt;
  }

  /// The same image behind the plainest headers there are.
  void begin_result(std::uint32_t bits, std::uint64_t pixel_bytes) {
    const bool has_masks = bitmap_.packing == bit_fields && bits == 16;
    // The reader takes a fourth mask, of alpha, which it does not use.
    const std::uint32_t masks_size = has_masks ? 16 : 0;
    const std::uint32_t pixels_at =
        file_header_size + info_header + masks_size + static_cast<std::uint32_t>(palette_.size());
    result_.reserve(pixels_at + pixel_bytes);
    result_.assign("BM");
    append_four_bytes(result_, 0);  // Size of the file, which nobody looks at.
    append_four_bytes(result_, 0);
    append_four_bytes(result_, pixels_at);
    append_four_bytes(result_, info_header);
    append_four_bytes(result_, static_cast<std::uint32_t>(bitmap_.width));
    const auto height = static_cast<std::uint32_t>(bitmap_.height);
    append_four_bytes(result_, bitmap_.is_top_down ? 0 - height : height);
    append_two_bytes(result_, 1);
    append_two_bytes(result_, bits);
    append_four_bytes(result_, has_masks ? bit_fields : unpacked);
    append_four_bytes(result_, 0);  // Size of the pixels.
    append_four_bytes(result_, 0);  // Resolution, in x and y.
    append_four_bytes(result_, 0);
    append_four_bytes(result_, bitmap_.colors);
    append_four_bytes(result_, 0);
    if (has_masks) {
      for (const std::uint32_t mask : bitmap_.masks) append_four_bytes(result_, mask);
      append_four_bytes(result_, 0);
    }
    result_ += palette_;
  }

  std::optional<Diagnostic> take_rows() {
    const std::uint64_t count = bitmap_.row_bytes() * static_cast<std::uint64_t>(bitmap_.height);
    if (cursor_.left() < count) return broken("the file ends before the image does");
    begin_result(bitmap_.bits, count);
    std::string piece;
    for (std::uint64_t left = count; left > 0; left -= piece.size()) {
      if (!cursor_.take(std::min<std::uint64_t>(left, 1u << 16), piece)) {
        return broken("the file ends before the image does");
      }
      result_ += piece;
    }
    return std::nullopt;
  }

  /// Runs are written out, a byte a pixel: the reader takes them for three channels where
  /// it has room for one, if the palette is grey.
  std::optional<Diagnostic> take_runs() {
    const auto width = static_cast<std::uint64_t>(bitmap_.width);
    const auto height = static_cast<std::uint64_t>(bitmap_.height);
    const std::uint64_t pixels = width * height;
    if (auto problem = check_image_bytes(
            file_, {.decoded = 3 * pixels, .kept = 3 * pixels, .in_memory = 4 * pixels}, limits_)) {
      return problem;
    }
    const std::uint64_t row = (width + 3) / 4 * 4;
    begin_result(8, row * height);
    const std::size_t start = result_.size();
    result_.resize(start + static_cast<std::size_t>(row * height), '\0');
    if (auto reason = write_out_bmp_runs(
            cursor_, {.width = width, .height = height, .is_nibbles = bitmap_.packing == runs_of_4},
            result_.data() + start)) {
      return broken(std::move(*reason));
    }
    return std::nullopt;
  }

  const ImageFile& file_;
  const ImageLimits& limits_;
  ImageExtent extent_;
  FileCursor cursor_;
  std::string& result_;
  Bitmap bitmap_;
  std::uint32_t header_size_ = 0;
  std::string palette_;
};

}  // namespace

std::optional<Diagnostic> essential_bmp(const ImageFile& file, const ImageLimits& limits,
                                        ImageExtent extent, std::string& bytes) {
  return BmpReader(file, limits, extent, bytes).run();
}

}  // namespace nacre
