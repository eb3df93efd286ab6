#pragma once

#include <vector>

#include "examples/render/render_context.h"
#include "examples/render/sampler.h"
#include "examples/render/tiles.h"
#include "examples/render/wavefront.h"

namespace nacre::host {

/// Where the paths of an image begin, with the memory of one thread.
class CameraPaths {
 public:
  explicit CameraPaths(const RenderContext& context) : context_(context) {}

  /// In place of what `paths` held: those of the samples [first, last) of a tile, one sample of all
  /// pixels after another, its rows from the top.
  void begin(const Tile& tile, int first, int last, std::vector<Path>& paths);

 private:
  void place_keys(const Tile& tile, int first, int last);
  void draw(Draw what, std::vector<Uniform2>& numbers) const;

  const RenderContext& context_;
  std::vector<SampleKey> keys_;
  std::vector<Uniform2> places_, lenses_, times_;  ///< Of the paths; 0 where nothing asks for them.
};

}  // namespace nacre::host
