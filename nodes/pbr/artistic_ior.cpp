#include "runtime/node/node_call.h"

namespace nacre {

namespace {

struct Ior {
  Float n, k;
};

/// Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014, in a form
/// that doesn't cancel for r near 1: with n_max = (1 + sqrt r) / (1 - sqrt r) and
/// n_min = (1 - r) / (1 + r), the paper's k^2 factors into
/// g (n_max - n_min)(n - 1 / n_max).
Ior ior_of(Float reflectivity, Float edge) {
  const Float r = clamp(reflectivity, 0.0f, 0.99999f);
  const Float root = sqrt(r);
  // 1 - sqrt r = (1 - r) / (1 + sqrt r), exactly where r is near 1.
  const Float n_max = square(1.0f + root) / (1.0f - r);
  const Float n_min = (1.0f - r) / (1.0f + r);
  const Float n = fma(edge, n_min - n_max, n_max);
  return {n, safe_sqrt(edge * (n_max - n_min) * (n - 1.0f / n_max))};
}

}  // namespace

/// Complex index of refraction of a metal with that reflectivity at normal
/// incidence and that tint at the edge. MaterialX 1.39 Physically Based Shading
/// Nodes, "artistic_ior". The reflectivity is limited to [0, 0.99999]; MaterialX's
/// generators stop at 0.99, so that a white metal there loses a hundredth. NaN
/// reflectivity counts as 0; the tint is not limited, and NaN in it passes to n
/// with k = 0.
void record_artistic_ior(NodeCall& call) {
  const Float3 reflectivity = call.vector3("reflectivity");
  const Float3 edge = call.vector3("edge_color");
  const Ior x = ior_of(reflectivity.x, edge.x);
  const Ior y = ior_of(reflectivity.y, edge.y);
  const Ior z = ior_of(reflectivity.z, edge.z);
  call.set("ior", Float3(x.n, y.n, z.n));
  call.set("extinction", Float3(x.k, y.k, z.k));
}

}  // namespace nacre
