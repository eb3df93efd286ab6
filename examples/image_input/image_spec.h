#pragma once

#include <OpenImageIO/imageio.h>

#include "examples/image_input/opened_graph.h"

namespace graph_image {

/// Texels on a side of a tile.
constexpr int tile_side = 64;

/// Of samples.
OIIO::TypeDesc format_of(const Request& request);

/// The numbers alone that a level has.
OIIO::ImageSpec dimensions_of(const GraphInfo& info, const Request& request, const Level& level);

/// What OpenImageIO is told of a level: its size in tiles of 64 x 64, channels (Y; R, G, B, A; of
/// matrices m0, m1, ...), and of the whole that it is a texture with its wrap modes, of colours
/// that they are linear, and as "mtlx:output", "mtlx:type" and, where there are any,
/// "mtlx:warnings" what it is of.
OIIO::ImageSpec spec_of(const GraphInfo& info, const Request& request, const Level& level);

}  // namespace graph_image
