#include "runtime/texture/exr_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "runtime/texture/essential_image.h"

namespace nacre {

namespace {

constexpr std::uint32_t flag_multipart = 0x1000;
constexpr std::size_t longest_name = 255;
constexpr std::uint64_t longest_header = std::uint64_t{16} << 20;  // Of all parts together.
constexpr std::uint64_t offset_bytes = 8;  // Of each chunk in the table behind the headers.

/// Largest number of lines compressed together, by the number of the method.
constexpr std::array<std::uint64_t, 10> chunk_lines{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

/// Attributes of a size that their type says; OpenEXR reads that many bytes whatever
/// the header claims.
struct FixedSize {
  std::string_view type;
  std::size_t bytes;
};
constexpr std::array fixed_sizes = std::to_array<FixedSize>({{"box2f", 16},
                                                             {"box2i", 16},
                                                             {"chromaticities", 32},
                                                             {"compression", 1},
                                                             {"deepImageState", 1},
                                                             {"double", 8},
                                                             {"envmap", 1},
                                                             {"float", 4},
                                                             {"int", 4},
                                                             {"keycode", 28},
                                                             {"lineOrder", 1},
                                                             {"m33d", 72},
                                                             {"m33f", 36},
                                                             {"m44d", 128},
                                                             {"m44f", 64},
                                                             {"rational", 8},
                                                             {"tiledesc", 9},
                                                             {"timecode", 8},
                                                             {"v2d", 16},
                                                             {"v2f", 8},
                                                             {"v2i", 8},
                                                             {"v3d", 24},
                                                             {"v3f", 12},
                                                             {"v3i", 12}});

struct Window {
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// What one header says about the memory that its image takes.
struct Part {
  Window data;
  Window display;
  Window tile;  ///< Zero where there are none.
  std::uint64_t channels = 0;
  std::uint64_t lines = 1;
};

std::uint32_t word(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

std::int64_t signed_word(std::string_view bytes, std::size_t at) {
  return static_cast<std::int32_t>(word(bytes, at));
}

class HeaderReader {
 public:
  HeaderReader(const ImageFile& file, const ImageLimits& limits)
      : cursor_(file), file_(file), limits_(limits) {}

  std::optional<Diagnostic> run() {
    std::string start;
    if (!cursor_.take(8, start)) {
      return broken_image(file_.path(), "the file ends inside its signature");
    }
    const bool is_multipart = (word(start, 4) & flag_multipart) != 0;
    bool ended = false;
    for (int parts = 0; !ended && !fault_; ++parts) {
      Part part;
      const int attributes = read_part(part);
      ended = !is_multipart || attributes == 0;
      if (fault_) break;
      if (attributes > 0) {
        for (const Window& window : {part.data, part.display}) {
          auto problem = check_image_size(file_.path(), window.width, window.height, limits_);
          if (problem) return problem;
        }
        check_part(part);
      }
      if (!fault_ && !ended && parts >= limits_.max_layers) {
        fault_ = fmt::format("there are more than {} parts", limits_.max_layers);
      }
    }
    if (fault_) return broken_image(file_.path(), *fault_);
    return std::nullopt;
  }

 private:
  /// Text up to a zero byte.
  bool take_text(std::string& text) {
    text.clear();
    for (std::string byte; text.size() <= longest_name;) {
      if (cursor_.at() > longest_header || !cursor_.take(1, byte)) break;
      if (byte[0] == '\0') return true;
      text += byte[0];
    }
    fault_ = "the header is cut short, or it or a name in it is too long";
    return false;
  }

  /// Attributes up to the empty name; how many there were.
  int read_part(Part& part) {
    int count = 0;
    for (;; ++count) {
      std::string name, type, size, data;
      if (!take_text(name) || name.empty()) return count;
      if (!take_text(type)) return count;
      if (!cursor_.take(4, size) || word(size, 0) > longest_header ||
          !cursor_.take(word(size, 0), data)) {
        fault_ = fmt::format("attribute '{}' claims more bytes than the file has", name);
        return count;
      }
      if (!read_attribute(part, name, type, data)) {
        fault_ = fmt::format("attribute '{}' contradicts its own size", name);
        return count;
      }
    }
  }

  /// False: the sizes inside an attribute do not fit it.
  static bool read_attribute(Part& part, std::string_view name, std::string_view type,
                             std::string_view data) {
    for (const FixedSize& fixed : fixed_sizes) {
      if (fixed.type == type && fixed.bytes != data.size()) return false;
    }
    if (name == "dataWindow" || name == "displayWindow") {
      if (type != "box2i") return false;
      (name == "dataWindow" ? part.data : part.display) = {
          signed_word(data, 8) - signed_word(data, 0) + 1,
          signed_word(data, 12) - signed_word(data, 4) + 1};
    } else if (name == "tiles") {
      if (type != "tiledesc") return false;
      part.tile = {word(data, 0), word(data, 4)};
    } else if (name == "compression") {
      if (type != "compression") return false;
      const auto method = static_cast<unsigned char>(data[0]);
      part.lines = chunk_lines[std::min<std::size_t>(method, chunk_lines.size() - 1)];
    } else if (type == "chlist") {
      const auto channels = channel_count(data);
      if (name == "channels") part.channels = channels.value_or(0);
      return channels.has_value();
    } else if (type == "preview") {
      return data.size() >= 8 &&
             std::uint64_t{word(data, 0)} * word(data, 4) == (data.size() - 8) / 4;
    } else if (type == "stringvector") {
      return strings_fit(data);
    } else if (type == "idmanifest") {
      return false;  // Packed, with the size unpacked beside it; nothing of ours reads it.
    }
    return true;
  }

  static bool strings_fit(std::string_view data) {
    while (!data.empty()) {
      if (data.size() < 4 || word(data, 0) > data.size() - 4) return false;
      data.remove_prefix(4 + word(data, 0));
    }
    return true;
  }

  /// A name, its zero byte, and 16 bytes each, up to an empty name. Nothing if that does
  /// not end with the data.
  static std::optional<std::uint64_t> channel_count(std::string_view data) {
    std::uint64_t channels = 0;
    for (;;) {
      const std::size_t end = data.find('\0');
      if (end == 0 && data.size() == 1) return channels;
      if (end == std::string_view::npos || end == 0 || data.size() < end + 17) return std::nullopt;
      data.remove_prefix(end + 17);
      ++channels;
    }
  }

  bool outside(const Window& window) const {
    return window.width < 1 || window.width > limits_.max_size || window.height < 1 ||
           window.height > limits_.max_size;
  }

  void check_part(const Part& part) {
    const bool is_tiled = part.tile.width != 0 || part.tile.height != 0;
    if (part.channels > static_cast<std::uint64_t>(limits_.max_channels)) {
      fault_ = fmt::format("there are more than {} channels", limits_.max_channels);
      return;
    }
    if (is_tiled && outside(part.tile)) {
      fault_ = fmt::format("a tile is larger than {} or smaller than 1", limits_.max_size);
      return;
    }
    const Window chunk =
        is_tiled ? part.tile : Window{part.data.width, static_cast<std::int64_t>(part.lines)};
    const auto bytes = static_cast<std::uint64_t>(chunk.width * chunk.height) * part.channels * 4;
    const auto chunks = static_cast<std::uint64_t>(((part.data.width - 1) / chunk.width + 1) *
                                                   ((part.data.height - 1) / chunk.height + 1));
    if (bytes > limits_.max_bytes) {
      fault_ = "lines or tiles that are read together take too many bytes";
    } else if (chunks * offset_bytes > file_.bytes()) {
      fault_ = "the header promises more lines or tiles than the file has room for";
    }
  }

  FileCursor cursor_;
  const ImageFile& file_;
  const ImageLimits& limits_;
  std::optional<std::string> fault_;
};

}  // namespace

std::optional<Diagnostic> check_exr_header(const ImageFile& file, const ImageLimits& limits) {
  return HeaderReader(file, limits).run();
}

}  // namespace nacre
