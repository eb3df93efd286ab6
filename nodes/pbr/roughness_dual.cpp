#include "runtime/node/node_call.h"

namespace nacre {

/// Microfacet alphas along tangent and bitangent: the squares, in [1e-8, 1]. A
/// negative second roughness stands for the first. MaterialX 1.39 Physically Based
/// Shading Nodes, "roughness_dual". NaN counts as 0.
void record_roughness_dual(NodeCall& call) {
  const Float2 roughness = call.vector2("roughness");
  const auto alpha = [](Float r) { return clamp(r * r, 1e-8f, 1.0f); };
  const Float x = alpha(roughness.x);
  call.set(Float2{x, select(roughness.y < 0.0f, x, alpha(roughness.y))});
}

}  // namespace nacre
