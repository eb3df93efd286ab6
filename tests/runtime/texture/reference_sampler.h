#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "runtime/texture/sampling.h"

namespace nacre {

using Rgba64 = std::array<double, 4>;

struct ReferenceFootprint {
  double dudx = 0;
  double dvdx = 0;
  double dudy = 0;
  double dvdy = 0;
};

struct ReferenceModes {
  TextureFilter filter = TextureFilter::linear;
  AddressMode u = AddressMode::periodic;
  AddressMode v = AddressMode::periodic;
  int max_anisotropy = 1;
};

/// The oracle for every sampler: runtime/texture/sampling.h said again in double
/// precision, as plainly as can be, sharing no code with the library. It reads the file
/// with OpenImageIO and keeps a pyramid of doubles that no texel format has rounded:
/// allow half a step of the format (1/510 for rgba8) wherever a level but 0 takes part.
class ReferenceSampler {
 public:
  /// The first subimage and at most its first four channels. Nothing if it cannot be read.
  static std::optional<ReferenceSampler> open(const std::string& path);

  /// Channels the image lacks are 0 and alpha 1.
  Rgba64 sample(double u, double v, const ReferenceFootprint& footprint,
                const ReferenceModes& modes, const Rgba64& default_value) const;

  /// Half axes, in texels, of the ellipse that a footprint is, and where the longer one
  /// points: the angle from the u axis.
  struct Ellipse {
    double major = 0;
    double minor = 0;
    double angle = 0;
  };
  Ellipse ellipse(const ReferenceFootprint& footprint) const;

  int width(int level) const { return pyramid_[static_cast<std::size_t>(level)].width; }
  int height(int level) const { return pyramid_[static_cast<std::size_t>(level)].height; }
  int levels() const { return static_cast<int>(pyramid_.size()); }
  /// y counts from the bottom.
  const Rgba64& texel(int level, int x, int y) const;

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<Rgba64> texels;
  };
  static Level halved(const Level& fine);
  Rgba64 sample_levels(double u, double v, double width, const ReferenceModes& modes) const;
  Rgba64 sample_level(double u, double v, int level, const ReferenceModes& modes) const;

  std::vector<Level> pyramid_;
};

}  // namespace nacre
