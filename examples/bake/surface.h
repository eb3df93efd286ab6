#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/program/program.h"

namespace nacre::host {

struct BakeSettings;

/// Where an image is sampled, in texels from its upper left corner: the middle of the first
/// one is (1/2, 1/2). Footprints are so many texels wide and high.
struct TexelPoints {
  std::vector<float> x, y;
  float footprint = 1.0f;
  /// row * width + column of the one that each is in; the plane needs none.
  std::vector<std::size_t> texel = {};
};

/// What is baked as it lies in an image, as one thread asks for it: which texels it is in, and the
/// values of a kernel's input channels (runtime/node/geometry.h) at points.
class SurfacePoints {
 public:
  virtual ~SurfacePoints() = default;

  /// Makes ready for points of rows [first, first + rows).
  virtual void enter(int first, int rows) { (void)first, (void)rows; }
  /// Whether a texel of these rows has some of the surface in it.
  virtual bool covers(std::size_t texel) const { return (void)texel, true; }
  /// Finds points, before they are filled in. Of each 1 where it is on the surface; where it is
  /// not, it is moved to the point of the surface next to its texel's middle. Empty: all are.
  /// Texels of points are covered.
  virtual std::span<const std::uint8_t> place(const TexelPoints& points) {
    return (void)points, std::span<const std::uint8_t>{};
  }
  /// Values of an input channel for points, integers and booleans as floats. Unknown channels
  /// are 0.
  virtual void fill(std::string_view channel, const TexelPoints& points,
                    std::vector<float>& values) const = 0;
  /// Whether that depends on `points` by their number and footprint only.
  virtual bool is_constant(std::string_view channel) const = 0;
  /// Turns vectors at the points last placed from world space into the surface's frame there: how
  /// much of the tangent, the bitangent and the normal they have.
  virtual void turn_into_frame(const std::array<std::span<float>, 3>& vectors) const {
    (void)vectors;
  }
};

/// What is baked; one for all threads.
class BakeSurface {
 public:
  virtual ~BakeSurface() = default;

  /// As it lies in an image, for a kernel of that program.
  virtual std::unique_ptr<SurfacePoints> points(const BakeSettings& settings,
                                                const Program& program) const = 0;
};

}  // namespace nacre::host
