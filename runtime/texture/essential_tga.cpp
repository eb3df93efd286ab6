#include <algorithm>
#include <cstdint>
#include <string_view>

#include "runtime/texture/essential_image.h"

namespace nacre {

std::optional<Diagnostic> essential_tga(const ImageFile& file, const ImageLimits& limits,
                                        ImageExtent extent, std::string& bytes) {
  constexpr std::string_view version_2 = "TRUEVISION-XFILE.";
  std::string header;
  if (!FileCursor(file).take(image_signature_bytes, header)) {
    return broken_image(file.path(), "the file ends inside its header");
  }
  const auto byte = [&](std::size_t at) {
    return static_cast<std::uint64_t>(static_cast<unsigned char>(header[at]));
  };
  const std::uint64_t width = byte(12) | byte(13) << 8;
  const std::uint64_t height = byte(14) | byte(15) << 8;
  if (auto problem = check_image_size(file.path(), static_cast<std::int64_t>(width),
                                      static_cast<std::int64_t>(height), limits)) {
    return problem;
  }
  if (extent == ImageExtent::header) {
    // The reader passes over the identification, and looks for a mark at the end.
    bytes = header;
    bytes.resize(image_signature_bytes + static_cast<std::size_t>(byte(0)) + 2 * version_2.size());
    return std::nullopt;
  }
  const bool is_packed = (byte(2) & 8) != 0;
  const std::uint64_t pixels = width * height;
  const std::uint64_t unpacked = image_signature_bytes + byte(0) + pixels * ((byte(16) + 7) / 8);
  if (!is_packed && file.bytes() < unpacked) {
    return broken_image(file.path(), "the file ends before the image does");
  }
  // Packed, each pixel may have a count before it.
  const std::uint64_t most = is_packed ? unpacked + pixels : unpacked;
  if (!FileCursor(file).take(std::min(most, file.bytes()), bytes)) {
    return broken_image(file.path(), "it ends early");
  }
  // The reader looks for the mark at the end; one byte more, too little for a pixel, and it
  // is not there.
  const std::size_t mark = bytes.size() - image_signature_bytes;
  if (std::string_view(bytes).substr(mark, version_2.size()) == version_2) bytes += '\0';
  return std::nullopt;
}

}  // namespace nacre
