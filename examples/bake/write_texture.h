#pragma once

#include <memory>
#include <string>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/bake/texture_encoding.h"
#include "examples/common/partial_file.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// The smallest and largest value of each channel, as computed; NaN does not count.
struct TexelRange {
  std::vector<float> least, most;
  bool is_uniform() const { return least == most; }
};

/// Bakes one output into a partial file that waits to be committed; the kernel's graph was
/// built with `output_space`. The extension of `path` says what is written:
///
///   .exr  32 bits, or 16: floats, as computed
///   .png  8 bits, or 16: integers, clamped to [0, 1]
///   .tx   a tiled, mip-mapped texture of 32-bit or 16-bit floats, that repeats; a tile
///         of a set does not
///
/// Other numbers of bits are an error. One channel for float, boolean and integer,
/// else as many as the type has or `encoding` asks for. Widens `range`, of those
/// channels, if there is one. Null after an error, or without one if stopped. The bytes
/// depend on nothing but all this: no time, no host.
///
/// What a file cannot hold is cut off at its ends: a warning, how much and what there was.
/// For vectors, of which half would be lost, it is an error, and there is no file. Whoever
/// asks for the range judges that himself.
std::unique_ptr<PartialFile> bake_to_partial_file(const OutputKernel& kernel, std::size_t output,
                                                  const BakeSettings& settings,
                                                  const TextureEncoding& encoding,
                                                  const std::string& path, Diagnostics& diagnostics,
                                                  const BakeControl& control = {},
                                                  TexelRange* range = nullptr);

/// The same, committed: the file appears whole or not at all.
bool bake_to_file(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                  const TextureEncoding& encoding, const std::string& path,
                  Diagnostics& diagnostics, const BakeControl& control = {},
                  TexelRange* range = nullptr);

/// Gives a partial file its name; false with an error if that fails.
bool commit(PartialFile& file, Diagnostics& diagnostics);

}  // namespace nacre::host
