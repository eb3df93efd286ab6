#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

namespace nacre {

/// What IHDR says (PNG Specification, Third Edition, 11.2.1).
struct PngHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t depth = 0;
  std::uint32_t color_type = 0;
  std::uint32_t methods = 0;  ///< Of compression and of filters, of which there is one each.
  std::uint32_t interlacing = 0;

  /// From the 13 bytes of the chunk.
  explicit PngHeader(std::string_view bytes);
  bool is_valid() const;
  bool has_palette() const { return color_type == 3; }
  /// In the file.
  std::uint32_t samples() const;
};

/// Unpacks what IDAT chunks hold and keeps nothing: tells whether libpng will find every row
/// in it, which it otherwise says on stderr.
class PngData {
 public:
  explicit PngData(const PngHeader& header);
  ~PngData();
  PngData(const PngData&) = delete;
  PngData& operator=(const PngData&) = delete;

  /// The next bytes; false where they are damaged.
  bool take(std::string_view bytes);
  /// Whether every row was there, and the end.
  bool is_whole() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nacre
