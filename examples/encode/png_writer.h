#pragma once

#include <memory>
#include <string>

#include "examples/common/image_writer.h"

namespace nacre::host {

/// A PNG of 1 to 4 channels (grey, grey and alpha, RGB, RGBA) of 8 or 16 bits: W3C PNG, third
/// edition. Null, with the problem, if there can be no such file.
std::unique_ptr<ImageWriter> write_png(const std::string& file, const ImageHeader& header,
                                       std::string& problem);

}  // namespace nacre::host
