#pragma once

#include <memory>
#include <string>

#include "examples/common/image_writer.h"

namespace nacre::host {

/// Writes rows as they come, by OpenImageIO's writer of that name. Null, with the problem, if
/// there can be no such file.
std::unique_ptr<ImageWriter> write_rows(const std::string& file, const char* writer,
                                        const ImageHeader& header, std::string& problem);

}  // namespace nacre::host
