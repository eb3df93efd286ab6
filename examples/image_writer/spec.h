#pragma once

#include <OpenImageIO/imageio.h>

#include "examples/common/image_writer.h"

namespace nacre::host {

/// What OpenImageIO is told of an image. Files have no dates.
OIIO::ImageSpec spec_of(const ImageHeader& header);

/// What went wrong, for what certainly did: some writers fail without a word, and "" would
/// mean that nothing did.
inline std::string failure(const std::string& words) {
  return words.empty() ? "the image could not be written" : words;
}

}  // namespace nacre::host
