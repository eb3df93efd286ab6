#pragma once

#include <cstddef>
#include <vector>

namespace nacre::host {

/// Rows of a block of OpenEXR's compression ZIP.
constexpr int exr_block_rows = 16;

/// A block's bytes as OpenEXR's ZIP_COMPRESSION has them: even ones before odd ones, each less
/// the one before it, then zlib. Without compression, as that has it too, where it would
/// save less than an eighth: the lower bits of most floats are noise.
std::vector<unsigned char> compress_exr_block(std::vector<unsigned char> bytes);

}  // namespace nacre::host
