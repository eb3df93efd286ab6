#include "nodes/geometric/index.h"
#include "runtime/node/geometry.h"

namespace nacre {

/// Texture coordinates of the set `index`; a third component is 0. MaterialX 1.39
/// Standard Nodes, "texcoord". Passes as the host supplies it, however large, NaN
/// too.
void record_texcoord(NodeCall& call) {
  const Float2 uv = texcoord(call.recorder(), set_index(call));
  if (call.out_type() == Type::vector3) {
    call.set(Float3(uv.x, uv.y, 0.0f));
  } else {
    call.set(uv);
  }
}

}  // namespace nacre
