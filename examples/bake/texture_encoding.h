#pragma once

#include <string>
#include <string_view>

#include "runtime/type.h"

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
  /// What the file says that made it, the digest of the document it is of, and of what there; "":
  /// nothing.
  std::string software = {}, document = {}, output = {};
  /// The channels of the output to write; 0 of them: all.
  int first_channel = 0, channels = 0;
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

}  // namespace nacre::host
