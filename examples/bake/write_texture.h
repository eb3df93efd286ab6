#pragma once

#include <memory>
#include <string>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/bake/texel_statistics.h"
#include "examples/bake/texture_encoding.h"
#include "examples/common/partial_file.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// What a bake tells of a map's texels, as computed, of the channels that are written.
struct TextureReport {
  bool histogram = false;  ///< To be counted: from 0 to 1, of directions from -1.
  /// Whoever asks looks himself whether the file can hold the numbers; halves are still judged.
  bool is_judged = false;
  TexelStatistics statistics;  ///< Added to.
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
/// else as many as the type has or `encoding` asks for. Null after an error, or without one if
/// stopped. The bytes depend on nothing but all this: no time, no host, no threads.
///
/// What a file cannot hold is cut off at its ends: a warning, how much and what there was.
/// For vectors, of which half would be lost, it is an error, and there is no file. Texels that
/// have the most samples and are still not exact enough are a warning.
std::unique_ptr<PartialFile> bake_to_partial_file(const OutputKernel& kernel, std::size_t output,
                                                  const BakeSettings& settings,
                                                  const TextureEncoding& encoding,
                                                  const std::string& path, Diagnostics& diagnostics,
                                                  const BakeControl& control = {},
                                                  TextureReport* report = nullptr);

/// The same, committed: the file appears whole or not at all.
bool bake_to_file(const OutputKernel& kernel, std::size_t output, const BakeSettings& settings,
                  const TextureEncoding& encoding, const std::string& path,
                  Diagnostics& diagnostics, const BakeControl& control = {},
                  TextureReport* report = nullptr);

/// Gives a partial file its name; false with an error if that fails.
bool commit(PartialFile& file, Diagnostics& diagnostics);

}  // namespace nacre::host
