#pragma once

#include <memory>
#include <string>

#include "examples/common/image_writer.h"

namespace nacre::host {

/// Whether a texture is to be written while it is made: it has so many texels that they are not
/// kept in memory, and sides that are powers of two, so that each texel of a level is the mean of
/// four of the one before.
bool is_streamed(const ImageHeader& header);

/// Writes the finest level at once, and keeps the others in files beside `file` until it is whole.
/// As write_levels does, but without the digest and the mean of the texels. Null, with the
/// problem, if there can be no such file.
std::unique_ptr<ImageWriter> stream_levels(const std::string& file, const ImageHeader& header,
                                           std::string& problem);

}  // namespace nacre::host
