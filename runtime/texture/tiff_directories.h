#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/texture/image_file.h"

namespace nacre {

/// What reading a TIFF file takes care of. (TIFF 6.0, section 2; BigTIFF.)
struct TiffDirectories {
  /// Where the numbers of entries stand that no reader is to see: profiles and descriptions
  /// in languages of their own, which are interpreted with less care than pixels are.
  std::vector<std::uint64_t> hidden;
  bool is_big_endian = false;
};

/// Walks all directories; a reason not to read the file, or nothing: one that claims more
/// than the file has, a circle, a volume, more than `limits.max_layers` of them.
std::optional<std::string> tiff_fault(const ImageFile& file, const ImageLimits& limits,
                                      TiffDirectories& directories);

/// Number that a hidden entry gets: of no known meaning.
inline constexpr std::uint16_t hidden_tiff_entry = 0xfffe;

}  // namespace nacre
