#pragma once

#include <string>

namespace nacre::bench {

inline constexpr int image_size = 2048;

/// Writes a smooth RGBA8 image of image_size^2, tiled and mip-mapped by OpenImageIO, in the
/// system's folder of temporary files, and returns its path; empty where that fails.
/// Smooth, so that filters that blend levels differently give nearly the same.
std::string write_image();

}  // namespace nacre::bench
