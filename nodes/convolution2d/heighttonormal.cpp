#include "runtime/node/node_call.h"

namespace nacre {

namespace {

/// v / |v|, upright (z >= 0); (0, 0, 1) where v is zero. Scaled by its greatest
/// component first: footprints may be so small that squares vanish.
Float3 upright_unit(Float3 v) {
  const Float largest = max_component({abs(v.x), abs(v.y), abs(v.z)});
  const Float sign = select(v.z < 0.0f, Float(-1.0f), 1.0f);
  const Float3 unit = normalize(v / Float3(largest) * Float3(sign));
  return select(largest > 0.0f, unit, Float3(0.0f, 0.0f, 1.0f));
}

}  // namespace

/// The tangent-space normal of a height map, encoded in [0, 1]: with h the height
/// times scale / 16 (the weight of a Sobel filter) and its exact derivatives over
/// the footprint, the normal of the surface (u, v, h). MaterialX 1.39 Standard
/// Nodes, "heighttonormal". Flat, (0.5, 0.5, 1), where the footprint is a point or
/// texcoord doesn't vary over it; upright where texcoord is mirrored.
void record_heighttonormal(NodeCall& call) {
  const Float height = call.number("in");
  const Float strength = call.number("scale") * (1.0f / 16.0f);
  const Float2 uv = call.vector2("texcoord");
  const auto along = [&](int axis) {
    return Float3(footprint_derivative(uv.x, axis), footprint_derivative(uv.y, axis),
                  footprint_derivative(height, axis) * strength);
  };
  const Float3 n = upright_unit(cross(along(0), along(1)));
  call.set(fma(n, Float3(0.5f), Float3(0.5f)));
}

}  // namespace nacre
