#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "jit/record/textures.h"
#include "nodes/texture2d/sampler.h"
#include "runtime/program/recorder.h"
#include "tests/runtime/texture/reference_sampler.h"

namespace nacre {

/// Points to look up, one array a coordinate.
struct LookupPoints {
  std::vector<float> u, v, dudx, dvdx, dudy, dvdy;
  std::vector<float> draw;  ///< texture_u, of those who read it: as many, or none.

  void add(float at_u, float at_v, const std::array<float, 4>& footprint = {});
  std::size_t size() const { return u.size(); }
  ReferenceFootprint footprint(std::size_t i) const;
};

/// Everything a float can be as a coordinate, and what is near the edges of an image of
/// that size, in all pairs that matter; no footprint.
LookupPoints edge_points(int width, int height);
/// uv in [-3, 3], footprints from 1/8 texel to past the whole image, of any shape.
LookupPoints random_points(int count, int width, int height, unsigned seed);

/// What the interpreter makes of a recorded body, at points whose uv set 0 they are:
/// four components each.
class RecordedLookup {
 public:
  using Body = std::function<Float4(Recorder&, TextureProvider&, Float2 uv)>;

  RecordedLookup(TextureStore& store, const Body& body);

  std::vector<std::array<float, 4>> run(const LookupPoints& points) const;

  const std::vector<Channel>& inputs() const { return kernel_->program().inputs; }
  bool reads(const std::string& channel) const;
  const Program& program() const { return kernel_->program(); }
  const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  Recorder recorder_;
  Diagnostics diagnostics_;
  RecordedTextures textures_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace nacre
