#pragma once

#include "runtime/node/node_call.h"
#include "runtime/value/vector.h"

namespace nacre {

/// Worley, "A Cellular Texture Basis Function", 1996, as MaterialX and Open Shading
/// Language define it: one feature point in every unit cell, at
/// 0.5 + jitter (r - 0.5) of it for the cell's random numbers r. Only the cells next
/// to that of p are searched, so with jitter above 1 a nearer point may be missed.
///
/// Sets one, two or three components by the type of the output. "style" other than 1: Euclidean
/// distances to the nearest points, in order. 1: random numbers (cellnoise)
/// of the cell in which the nearest point lies. Where no point is found, distance 1000 and
/// the cell of p: for coordinates that are infinite or NaN, and for a jitter so large
/// (some thousands) that the points lie beyond, infinite or NaN. Coordinates beyond the
/// range of int lie in its last cells.
void record_worley(NodeCall& call, Float2 p);
void record_worley(NodeCall& call, Float3 p);

}  // namespace nacre
