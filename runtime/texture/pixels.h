#pragma once

#include <cstddef>
#include <optional>

#include "runtime/diagnostic.h"
#include "runtime/texture/image_io.h"

namespace nacre {

/// An image in the host's memory, its top row first.
struct Pixels {
  int width = 0;
  int height = 0;
  int channels = 0;                            ///< 1 to 4.
  SampleType samples = SampleType::unsigned8;  ///< Unsigned ones are fractions of the largest.
  const void* data = nullptr;                  ///< Channels together.
  std::ptrdiff_t row_bytes = 0;                ///< From one row to the next; 0: as long as a row.
};

/// As an ImageReader would say it of a file.
ImageInfo info_of(const Pixels& pixels);

/// What is wrong with the sizes, by `name`; nothing where they can be meant.
std::optional<Diagnostic> fault_of(const Pixels& pixels, const std::string& name,
                                   const ImageLimits& limits);

/// A row as floats, width * channels; y = 0 is the top one.
void read_row(const Pixels& pixels, int y, float* samples);

}  // namespace nacre
