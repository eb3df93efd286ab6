#include <algorithm>
#include <cstdint>

#include "runtime/texture/essential_image.h"

namespace nacre {

namespace {

constexpr int most_scans = 100;  // Encoders write about ten; a progressive script at most 64.
constexpr std::size_t always_read = std::size_t{64} << 20;
constexpr std::size_t read_at_once = std::size_t{1} << 16;  // Of a header.

// Second bytes of markers; the first is 0xff. ITU-T T.81, table B.1.
constexpr int first_restart = 0xd0, last_restart = 0xd7, start_of_image = 0xd8, end_of_image = 0xd9;
constexpr int start_of_scan = 0xda, first_application = 0xe0, adobe = 0xee, last_application = 0xef;
constexpr int comment = 0xfe, tables_of_huffman = 0xc4, reserved = 0xc8,
              tables_of_arithmetic = 0xcc;

bool starts_frame(int marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != tables_of_huffman && marker != reserved &&
         marker != tables_of_arithmetic;
}

bool is_left_out(int marker) {
  const bool is_application = marker >= first_application && marker <= last_application;
  return marker == comment || (is_application && marker != first_application && marker != adobe);
}

class JpegReader {
 public:
  JpegReader(const ImageFile& file, const ImageLimits& limits, ImageExtent extent,
             std::string& bytes)
      : file_(file), limits_(limits), extent_(extent), result_(bytes) {}

  std::optional<Diagnostic> run() {
    const std::size_t first = extent_ == ImageExtent::whole ? always_read : read_at_once;
    if (!load(std::min<std::uint64_t>(file_.bytes(), first))) return broken("it ends early");
    result_.assign("\xff\xd8");
    at_ = 2;
    for (;;) {
      const int marker = next_marker();
      if (marker == end_of_image) {
        result_ += "\xff\xd9";
        return std::nullopt;
      }
      if (marker < 0) return broken("the file ends before the image does");
      if (marker == start_of_image) return broken("an image begins inside the image");
      if (auto problem = take_segment(marker)) return problem;
      if (marker != start_of_scan) continue;
      if (extent_ == ImageExtent::header) {
        // Readers of several scans look at all of them when they begin: there is none.
        result_ += "\xff\xd9";
        return std::nullopt;
      }
      if (++scans_ > most_scans) return broken("the image has too many scans");
      take_scan();
    }
  }

 private:
  std::optional<Diagnostic> broken(std::string reason) const {
    return broken_image(file_.path(), std::move(reason));
  }

  bool load(std::uint64_t count) {
    const std::size_t known = whole_.size();
    whole_.resize(static_cast<std::size_t>(count));
    return file_.read(known, whole_.data() + known, whole_.size() - known) == whole_.size() - known;
  }

  /// Whether the file has so many bytes, which are there then. A header goes on for as long as
  /// its segments do.
  bool reaches(std::size_t end) {
    if (end <= whole_.size()) return true;
    if (extent_ == ImageExtent::whole || end > file_.bytes()) return false;
    return load(std::min<std::uint64_t>(file_.bytes(), end + read_at_once));
  }

  int byte(std::size_t at) const { return static_cast<unsigned char>(whole_[at]); }
  int two_bytes(std::size_t at) const { return byte(at) << 8 | byte(at + 1); }

  /// Moves behind the next marker, past any filling; its number, -1 where there is none.
  int next_marker() {
    while (reaches(at_ + 2)) {
      if (byte(at_) != 0xff) return -1;
      const int marker = byte(++at_);
      if (marker == 0xff) continue;
      ++at_;
      return marker == 0 ? -1 : marker;
    }
    return -1;
  }

  std::optional<Diagnostic> take_segment(int marker) {
    if (!reaches(at_ + 2)) return broken("the file ends inside a segment");
    const auto length = static_cast<std::size_t>(two_bytes(at_));
    if (length < 2 || !reaches(at_ + length)) return broken("a segment is cut short");
    if (starts_frame(marker)) {
      if (auto problem = take_frame(length)) return problem;
    }
    if (!is_left_out(marker)) {
      result_ += '\xff';
      result_ += static_cast<char>(marker);
      result_.append(whole_, at_, length);
    }
    at_ += length;
    return std::nullopt;
  }

  /// The size of the image, which says how much of the file may be read.
  std::optional<Diagnostic> take_frame(std::size_t length) {
    if (has_frame_) return broken("the image has two frames");
    has_frame_ = true;
    if (length < 8) return broken("a segment is cut short");
    const int height = two_bytes(at_ + 3), width = two_bytes(at_ + 5), channels = byte(at_ + 7);
    if (auto problem = check_image_size(file_.path(), width, height, limits_)) return problem;
    if (file_.bytes() <= whole_.size() || extent_ == ImageExtent::header) return std::nullopt;
    const std::uint64_t samples = static_cast<std::uint64_t>(width) *
                                  static_cast<std::uint64_t>(height) *
                                  static_cast<std::uint64_t>(channels);
    if (file_.bytes() > 4 * samples + always_read) {
      return broken("there is more data than the pixels need");
    }
    if (!load(file_.bytes())) return broken("it ends early");
    return std::nullopt;
  }

  /// Coded data up to the next marker that is none of its own.
  void take_scan() {
    std::size_t end = at_;
    for (;;) {
      end = whole_.find('\xff', end);
      if (end == std::string::npos || end + 1 >= whole_.size()) {
        end = whole_.size();
        break;
      }
      const int next = byte(end + 1);
      const bool is_data = next == 0 || (next >= first_restart && next <= last_restart);
      if (!is_data && next != 0xff) break;
      end += next == 0xff ? 1 : 2;
    }
    result_.append(whole_, at_, end - at_);
    at_ = end;
  }

  const ImageFile& file_;
  const ImageLimits& limits_;
  ImageExtent extent_;
  std::string& result_;
  std::string whole_;
  std::size_t at_ = 0;
  int scans_ = 0;
  bool has_frame_ = false;
};

}  // namespace

std::optional<Diagnostic> essential_jpeg(const ImageFile& file, const ImageLimits& limits,
                                         ImageExtent extent, std::string& bytes) {
  return JpegReader(file, limits, extent, bytes).run();
}

}  // namespace nacre
