#pragma once

#include <array>

#include "nodes/math/angle.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// One of the three hexagons that overlap at a point.
struct Hexagon {
  Float weight;     ///< In [0, 1]; the three add up to 1.
  Float2 texcoord;  ///< Where its copy of the image is looked up.
  SinCos rotation;  ///< Of that copy, counter-clockwise seen in texcoord space.
};

/// Hexagonal tiling by example: Mikkelsen, "Practical Real-Time Hex-Tiling", JCGT 11(2),
/// 2022, with the parameters of hextiledimage and hextilednormalmap, whose inputs
/// texcoord, tiling, rotation..., offsetrange it reads.
///
/// The lattice is that of (u, 1 - v): the library's renderers turn v over before this
/// function and read images from the top, and only so do images turn the way that
/// hextilednormalmap turns their frames. In these coordinates, times `tiling`, vertex
/// (i, j) lies at (i + j/2, j sqrt(3)/2) / (2 sqrt(3)). Its rotation, scale and offset come
/// from one hash of two floats (Hoskins, shadertoy.com/view/4djSRW), in binary32 and this
/// order of operations, so the tiles are the same in every engine; only the double
/// reference, and reassociation in `fast`, have other random numbers (by some 1e-4).
std::array<Hexagon, 3> find_hexagons(NodeCall& call);

/// Weights of the hexagons raised to the seventh power, times `emphasis`, moved by
/// Schlick's gain (Graphics Gems IV, 1994) with `falloff` (0.5: not at all; limited to
/// [0.001, 0.999]) and scaled to a sum of one. Zero where all are zero.
Float3 blend_weights(const std::array<Hexagon, 3>& hexagons, Float3 emphasis, Float falloff);

}  // namespace nacre
