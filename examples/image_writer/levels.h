#pragma once

#include <memory>
#include <string>

#include "examples/common/image_writer.h"

namespace nacre::host {

/// Keeps the rows, and writes them with levels of half the size each once all are there.
std::unique_ptr<ImageWriter> write_levels(const std::string& file, const ImageHeader& header);

}  // namespace nacre::host
