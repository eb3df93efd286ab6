#pragma once

#include <memory>
#include <string>

#include "examples/common/image_writer.h"

namespace nacre::host {

/// An EXR of one part in scan lines, compression ZIP, of 16 or 32 bits: "OpenEXR File Layout".
/// Not by OpenEXR, so that every thread compresses what it has shaded (bench/results/bake.md) and
/// OpenImageIO, which brings most of what there is to load, stays away; tests read the files by it.
/// Halves are rounded to nearest even; beyond 65504 finite numbers are cut off there. Null, with
/// the problem, if there can be no such file.
std::unique_ptr<ImageWriter> write_exr(const std::string& file, const ImageHeader& header,
                                       std::string& problem);

}  // namespace nacre::host
