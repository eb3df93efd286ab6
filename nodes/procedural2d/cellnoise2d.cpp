#include "nodes/noise/cell.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// One random number in [0, 1] for every unit cell. MaterialX 1.39 Standard Nodes,
/// "cellnoise2d". Coordinates beyond the range of int are those of its ends; NaN is
/// 0.
void record_cellnoise2d(NodeCall& call) { call.set(cell_noise(cell_of(call.vector2("texcoord")))); }

}  // namespace nacre
