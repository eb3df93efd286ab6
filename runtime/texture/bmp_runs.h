#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/texture/image_file.h"

namespace nacre {

struct BmpRuns {
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  bool is_nibbles = false;  ///< RLE4, two pixels a byte; RLE8 otherwise.
};

/// Writes the numbers of colours that runs mean, a byte each, into rows from the bottom to
/// the top that begin at multiples of four bytes and are zero. What is wrong with the runs,
/// if anything. Microsoft, "Bitmap Compression".
std::optional<std::string> write_out_bmp_runs(FileCursor& cursor, const BmpRuns& runs,
                                              char* pixels);

}  // namespace nacre
