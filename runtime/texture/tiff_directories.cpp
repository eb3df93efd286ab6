#include "runtime/texture/tiff_directories.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace nacre {

namespace {

constexpr std::uint64_t most_entries = 4096;  // Of one directory; files have about twenty.

/// Bytes of one value, by the number of its type; 1 for unknown ones.
constexpr std::array<std::uint64_t, 19> type_bytes{1, 1, 1, 2, 4, 8, 1, 1, 2, 4,
                                                   8, 4, 8, 4, 1, 1, 8, 8, 8};

// XMP, IPTC, Photoshop, Exif, ICC, GPS.
constexpr std::array<std::uint64_t, 6> hidden_entries{700, 33723, 34377, 34665, 34675, 34853};

constexpr std::uint64_t image_depth = 32997, tile_depth = 32998;

class Walk {
 public:
  Walk(const ImageFile& file, const ImageLimits& limits, TiffDirectories& directories)
      : file_(file), limits_(limits), result_(directories) {}

  std::optional<std::string> run() {
    std::string head;
    if (!FileCursor(file_).take(4, head)) return "the file ends inside its signature";
    result_.is_big_endian = head[0] == 'M';
    is_big_ = number(head, 2, 2) == 43;
    std::string first;
    if (!FileCursor(file_, is_big_ ? 8 : 4).take(is_big_ ? 8 : 4, first)) {
      return "the file ends inside its header";
    }
    std::set<std::uint64_t> seen;
    for (std::uint64_t at = number(first, 0, first.size()); at != 0;) {
      if (!seen.insert(at).second) return "its directories go round in a circle";
      if (seen.size() > static_cast<std::size_t>(limits_.max_layers)) {
        return fmt::format("there are more than {} pages or levels", limits_.max_layers);
      }
      if (auto fault = read_directory(at)) return fault;
    }
    if (seen.empty()) return "there is no directory";
    return std::nullopt;
  }

 private:
  std::uint64_t number(const std::string& bytes, std::size_t at, std::size_t count) const {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = result_.is_big_endian ? at + i : at + count - 1 - i;
      value = value << 8 | static_cast<unsigned char>(bytes[k]);
    }
    return value;
  }

  /// `at`: where it is, and then where the next one is.
  std::optional<std::string> read_directory(std::uint64_t& at) {
    const std::size_t entry_bytes = is_big_ ? 20 : 12;
    const std::size_t offset_bytes = is_big_ ? 8 : 4;
    FileCursor cursor(file_, at);
    std::string bytes;
    if (!cursor.take(is_big_ ? 8 : 2, bytes)) return "a directory lies behind the end of the file";
    const std::uint64_t count = number(bytes, 0, bytes.size());
    if (count > most_entries) return "a directory has too many entries";
    for (std::uint64_t i = 0; i < count; ++i) {
      const std::uint64_t place = cursor.at();
      if (!cursor.take(entry_bytes, bytes)) return "the file ends inside a directory";
      const std::uint64_t tag = number(bytes, 0, 2), type = number(bytes, 2, 2);
      if (std::ranges::find(hidden_entries, tag) != hidden_entries.end()) {
        result_.hidden.push_back(place);
      }
      const std::uint64_t values = number(bytes, 4, offset_bytes);
      const std::uint64_t size = type < type_bytes.size() ? type_bytes[type] : 1;
      if (values > file_.bytes() / size) {
        return fmt::format("entry {} claims more bytes than the file has", tag);
      }
      const bool is_depth = tag == image_depth || tag == tile_depth;
      if (is_depth && number(bytes, 4 + offset_bytes, size) > 1) return "it is a volume";
      if (values * size <= offset_bytes) continue;
      const std::uint64_t start = number(bytes, 4 + offset_bytes, offset_bytes);
      if (start > file_.bytes() || values * size > file_.bytes() - start) {
        return fmt::format("entry {} lies behind the end of the file", tag);
      }
    }
    if (!cursor.take(offset_bytes, bytes)) return "the file ends inside a directory";
    at = number(bytes, 0, offset_bytes);
    return std::nullopt;
  }

  const ImageFile& file_;
  const ImageLimits& limits_;
  TiffDirectories& result_;
  bool is_big_ = false;
};

}  // namespace

std::optional<std::string> tiff_fault(const ImageFile& file, const ImageLimits& limits,
                                      TiffDirectories& directories) {
  return Walk(file, limits, directories).run();
}

}  // namespace nacre
