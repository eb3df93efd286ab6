#pragma once

#include "runtime/node/texture_source.h"
#include "runtime/program/recorder.h"
#include "runtime/texture/sampling.h"
#include "runtime/value/vector.h"

namespace nacre {

/// A look-up of an image file, with what the node says about it.
struct ImageLookup {
  Float2 uv{};           ///< Any floats.
  TextureModes modes{};  ///< sample_images fills in max_anisotropy.
  int channels = 4;      ///< Components that the result needs, 1..4; the others are 0.
  Float4 otherwise{};    ///< The node's `default`.
};

/// Records a look-up of one image, as runtime/texture/sampling.h says, with the
/// footprint that uv has (footprint_derivative; for `closest` there is none). Where the
/// image is missing, and outside it in mode `constant`, the result is `otherwise`.
/// Components that the image lacks are 0 and alpha is 1.
///
/// Texels of an integer format are interpolated in steps of the format, exactly where
/// neighbours are equal; what is 1 in the file is 1 there.
Float4 sample_image(Recorder& recorder, const TextureSource& source, const ImageLookup& lookup);

/// The same for what a file name stands for: one image, or tiles by floor(u), floor(v).
/// Within a tile taps clamp at its edge, and the address modes do not count; where no
/// tile is the result is `otherwise`.
Float4 sample_images(Recorder& recorder, const TextureSources& sources, ImageLookup lookup);

}  // namespace nacre
