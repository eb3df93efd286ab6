#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nacre {

/// A row of pixels as a TGA file without compression (Truevision TGA 2.0, image type 2), each
/// 0xrrggbb.
inline std::string tga_of(const std::vector<std::uint32_t>& pixels) {
  std::string file(18, '\0');
  file[2] = 2;
  file[12] = static_cast<char>(pixels.size());
  file[14] = 1;
  file[16] = 24;
  for (const std::uint32_t pixel : pixels) {
    for (const int shift : {0, 8, 16}) file += static_cast<char>(pixel >> shift & 255u);
  }
  return file;
}

}  // namespace nacre
