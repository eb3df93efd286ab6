#pragma once

#include <cstddef>

#include "examples/image_input/request.h"

namespace graph_image {

/// One of the images of a MIP map. Level k has half the texels of level k - 1 on either side,
/// rounded down, at least 1. A texel of the finest level is what the graph gives at its centre,
/// for a footprint of the texel: `nacre bake` stores the same bits. One of any other level is the
/// mean of a grid of points across it, each with a footprint of its part:
///
///  * As many on a side as the finest level has texels there, up to Request::samples. As long as
///    that is enough, those are the finest level's own points, so the level is its box average.
///  * Coarser levels have that many points, not more, so that no level costs more than the finest
///    does. What varies faster than those points are apart is aliased there; what is smooth has
///    the error of the midpoint rule, h^2 / 24 times its second derivative for points h apart.
///
/// Images are filtered by their nodes for each footprint, so they need no more than one point.
struct Level {
  int width = 0, height = 0;
  int samples_x = 1, samples_y = 1;  ///< Points across a texel.
};

/// How many levels an image has, the last one of a single texel.
int level_count(int width, int height);

/// That level, 0 being the finest, of a request whose size is known.
Level level_of(const Request& request, int index);

/// Texels of a level: a rectangle, its corner the upper left.
struct Texels {
  int x = 0, y = 0;
  int width = 0, height = 0;

  std::size_t count() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
};

}  // namespace graph_image
