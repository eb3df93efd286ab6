#pragma once

#include <functional>
#include <span>
#include <string>

#include "examples/render/film.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

struct WriteOptions {
  bool half = false;     ///< EXR: 16-bit floats instead of 32.
  float exposure = 0.f;  ///< PNG: stops.
  /// PNG: the luminance that becomes white, by L (1 + L/w²) / (1 + L), which
  /// keeps hue (Reinhard et al. 2002, "Photographic Tone Reproduction for
  /// Digital Images", equation 4). 0: no curve, clip at 1.
  float white = 4.f;
  /// PNG: what takes the place of curve and sRGB; linear colours, three numbers each, become what
  /// the display is sent, 0 to 1.
  std::function<void(std::span<float>)> view = {};
  std::string view_name = {};  ///< PNG: said in the file where there is a view.
};

/// Whether write_image() can write a file of that name; an error if not.
bool is_image_name(const std::string& path, Diagnostics& diagnostics);

/// Writes .exr (linear Rec. 709 radiance, passes as layers) or .png (8 bits, tone curve, sRGB
/// transfer, no passes). Of a film that is a window the .exr has the data window within the display
/// window of the whole, the .png the window alone. A file appears complete or not at all: it is
/// written beside its place and renamed. The bytes depend on nothing but the image and options. A
/// film with alpha gives four channels; colours are multiplied by alpha in .exr and not in .png, as
/// is the custom of either. A warning says what 16-bit floats cannot hold.
bool write_image(const Film& film, const std::string& path, const WriteOptions& options,
                 Diagnostics& diagnostics);

}  // namespace nacre::host
