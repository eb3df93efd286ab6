#pragma once

#include <memory>
#include <string>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/common/partial_file.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// How texels become numbers of a file.
struct TextureEncoding {
  /// 8, 16 or 32; 0: what the extension is for, see `bake_to_file`.
  int bits = 0;
  /// Of colours, by any name that the graph knows; "none": as computed. "":
  /// srgb_texture in files of integers, as computed in others. See `output_space`.
  std::string colorspace = {};
  /// Unit vectors, stored as (v + 1) / 2 as normal maps are.
  bool is_direction = false;
  /// The same for every output whose type is a vector.
  bool encodes_vectors = false;
  /// One of a set of tiles: beyond its edges are others, not itself again.
  bool is_tile = false;
  /// The channels of the output to write; 0 of them: all.
  int first_channel = 0, channels = 0;
};

/// The smallest and largest value of each channel, as computed; NaN does not count.
struct TexelRange {
  std::vector<float> least, most;
  bool is_uniform() const { return least == most; }
};

/// The colour space that the texels of an output are in when they are written so;
/// "" for what is not a colour.
std::string texture_colorspace(Type type, const std::string& extension,
                               const TextureEncoding& encoding);

/// GraphOptions::output_space for the kernel of an output that is to be written so: the
/// curve of srgb_texture is put on when it is written, all else by the graph.
std::string output_space(const std::string& extension, const TextureEncoding& encoding);

/// True where a texture of such a space holds colours as sRGB codes, by any of its names.
bool is_srgb(std::string_view colorspace);

/// True if the numbers of such a file are from 0 to 1.
bool holds_unit_range_only(const std::string& extension);

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
