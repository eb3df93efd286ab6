#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>

#include "runtime/texture/essential_image.h"
#include "runtime/texture/little_endian.h"

namespace nacre {

namespace {

// The numbers of sections are those of the GIF89a specification.
constexpr std::size_t header_size = 13;                    // 17 and 18: header, screen descriptor.
constexpr std::size_t descriptor_size = 9;                 // 20, after its separator.
constexpr std::size_t whole_table = std::size_t{3} * 256;  // 19 and 21: colour tables.
constexpr std::uint32_t has_table = 0x80, is_interlaced = 0x40, size_of_table = 0x07;
constexpr char extension = 0x21, image_separator = 0x2c, trailer = 0x3b;
constexpr std::uint32_t plain_text = 0x01, graphic_control = 0xf9;  // 25 and 23.
constexpr std::uint32_t has_transparency = 0x01;
constexpr std::uint32_t smallest_code = 2, largest_code = 8;  // 22, appendix F.
/// Comments and metadata; each block of them may be as short as a byte.
constexpr std::uint64_t most_before_image = std::uint64_t{64} << 20;

class GifReader {
 public:
  GifReader(const ImageFile& file, const ImageLimits& limits, std::string& bytes)
      : file_(file), limits_(limits), cursor_(file), result_(bytes) {}

  std::optional<Diagnostic> run() {
    if (!cursor_.take(header_size, header_)) return broken("the file ends inside its header");
    if (auto problem = check_screen()) return problem;
    if (auto problem = take_table(byte_at(header_, 10))) return problem;
    for (std::string kind;;) {
      if (!cursor_.take(1, kind)) return broken("the file ends before its image");
      if (kind[0] == image_separator) return take_image();
      if (kind[0] == trailer) return broken("there is no image in the file");
      if (kind[0] != extension) return broken("a block is of no known kind");
      if (auto problem = take_extension()) return problem;
      if (cursor_.at() > most_before_image) return broken("the image begins too late in the file");
    }
  }

 private:
  std::optional<Diagnostic> broken(std::string reason) const {
    return broken_image(file_.path(), std::move(reason));
  }

  /// The reader has all of the screen in memory before it says how large it is, and counts
  /// its bytes in an int.
  std::optional<Diagnostic> check_screen() const {
    const std::uint64_t width = two_bytes_at(header_, 6), height = two_bytes_at(header_, 8);
    if (auto problem = check_image_size(file_.path(), static_cast<std::int64_t>(width),
                                        static_cast<std::int64_t>(height), limits_)) {
      return problem;
    }
    ImageLimits limits = limits_;
    limits.max_bytes =
        std::min<std::uint64_t>(limits.max_bytes, std::numeric_limits<std::int32_t>::max());
    const std::uint64_t bytes = 4 * width * height;
    return check_image_bytes(file_, {.decoded = bytes, .kept = bytes, .in_memory = bytes}, limits);
  }

  /// A colour table after the descriptor that has such flags, in place of an earlier one.
  std::optional<Diagnostic> take_table(std::uint32_t flags) {
    if ((flags & has_table) == 0) return std::nullopt;
    if (!cursor_.take(std::size_t{3} << ((flags & size_of_table) + 1), table_)) {
      return broken("the file ends inside a colour table");
    }
    return std::nullopt;
  }

  /// The next data sub-block (15), empty after the last one; false where the file ends.
  bool take_block(std::string& block) {
    return cursor_.take(1, block) && cursor_.take(byte_at(block, 0), block);
  }

  std::optional<Diagnostic> take_extension() {
    std::string label, block;
    if (!cursor_.take(1, label)) return broken("the file ends inside an extension");
    // Both are about the next picture, and a text is one.
    if (label[0] == static_cast<char>(plain_text)) control_.clear();
    const bool is_control = label[0] == static_cast<char>(graphic_control);
    for (bool is_first = true;; is_first = false) {
      if (!take_block(block)) return broken("the file ends inside an extension");
      if (is_control && (is_first ? 4u : 0u) != block.size()) {
        return broken("a graphic control extension has the wrong length");
      }
      if (block.empty()) return std::nullopt;
      if (is_control) control_ = block;
      if (cursor_.at() > most_before_image) return broken("the image begins too late in the file");
    }
  }

  std::optional<Diagnostic> take_image() {
    std::string descriptor, code_size;
    if (!cursor_.take(descriptor_size, descriptor)) {
      return broken("the file ends inside a descriptor");
    }
    const std::uint64_t width = two_bytes_at(descriptor, 4), height = two_bytes_at(descriptor, 6);
    if (width == 0 || height == 0 ||
        two_bytes_at(descriptor, 0) + width > two_bytes_at(header_, 6) ||
        two_bytes_at(descriptor, 2) + height > two_bytes_at(header_, 8)) {
      return broken("the image is not inside the screen");
    }
    const std::uint32_t flags = byte_at(descriptor, 8);
    if (auto problem = take_table(flags)) return problem;
    if (table_.empty()) return broken("the image has no colours");
    if (!cursor_.take(1, code_size)) return broken("the file ends before its image");
    if (byte_at(code_size, 0) < smallest_code || byte_at(code_size, 0) > largest_code) {
      return broken("the codes of the image have an impossible size");
    }
    begin_result();
    result_ += image_separator;
    result_.append(descriptor, 0, descriptor_size - 1);
    result_ += static_cast<char>(flags & is_interlaced);
    result_ += code_size;
    // Codes have at most twelve bits, and one that clears the table may precede each.
    const std::size_t most = result_.size() + 4 * width * height + (std::size_t{1} << 16);
    for (std::string block;;) {
      if (!take_block(block)) return broken("the file ends inside its image");
      result_ += static_cast<char>(block.size());
      result_ += block;
      if (block.empty()) break;
      if (result_.size() > most) return broken("there is more data than the pixels need");
    }
    result_ += trailer;
    return std::nullopt;
  }

  /// What precedes the image. Its table is the only one and has all colours that a code
  /// may mean, for the reader does not look whether there are so many.
  void begin_result() {
    table_.resize(whole_table, '\0');
    result_.assign("GIF89a");
    result_.append(header_, 6, 4);
    result_ += static_cast<char>(has_table | 0x70u | size_of_table);
    result_.append(2, '\0');  // Background colour and aspect ratio.
    result_ += table_;
    if (!control_.empty() && (byte_at(control_, 0) & has_transparency) != 0) {
      result_ += extension;
      result_ += static_cast<char>(graphic_control);
      result_ += '\4';
      result_ += static_cast<char>(has_transparency);
      result_.append(2, '\0');  // Delay.
      result_ += control_[3];
      result_ += '\0';
    }
  }

  const ImageFile& file_;
  const ImageLimits& limits_;
  FileCursor cursor_;
  std::string& result_;
  std::string header_;
  std::string table_;
  std::string control_;  ///< Of the extension, if there was one.
};

}  // namespace

std::optional<Diagnostic> essential_gif(const ImageFile& file, const ImageLimits& limits,
                                        ImageExtent, std::string& bytes) {
  return GifReader(file, limits, bytes).run();
}

}  // namespace nacre
