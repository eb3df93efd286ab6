#pragma once

#include <cstdint>

namespace nacre {

/// What an image may cost, checked before anything is allocated for it.
struct ImageLimits {
  int max_size = 16384;  ///< Of either side, of the pixels that there are and of the picture
                         ///< they are part of. Textures have at most 16384 whatever this says.
  std::uint64_t max_bytes = std::uint64_t{2} << 30;  ///< Decoded pixels of the part that is read.
  std::uint64_t max_file_bytes = std::uint64_t{2} << 30;  ///< Of the file as it is on disk.
  int max_channels = 1024;                                ///< In the file; four at most are kept.
  int max_layers = 1024;                                  ///< Parts, pages or levels in the file.
  /// Decoded bytes for each byte of the file, of an image that takes more than 256 MB in
  /// memory: photographs have tens, drawings hundreds, and a file of nothing 1,032.
  std::uint64_t max_expansion = 256;
};

}  // namespace nacre
