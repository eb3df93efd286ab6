#include "runtime/node/node_call.h"

namespace nacre {

/// Microfacet alphas along tangent and bitangent from a roughness and an
/// anisotropy: alpha = roughness^2 in [1e-8, 1], aspect = sqrt(1 - anisotropy) with
/// the anisotropy limited to 0.98, (alpha / aspect, alpha aspect), the first at most
/// 1. MaterialX 1.39 Physically Based Shading Nodes, "roughness_anisotropy".
/// Isotropic for an anisotropy of 0 and less. So for NaN; a NaN roughness counts as
/// 0.
void record_roughness_anisotropy(NodeCall& call) {
  const Float roughness = call.number("roughness");
  const Float alpha = clamp(roughness * roughness, 1e-8f, 1.0f);
  const Float aspect = sqrt(1.0f - clamp(call.number("anisotropy"), 0.0f, 0.98f));
  call.set(Float2{min(alpha / aspect, 1.0f), alpha * aspect});
}

}  // namespace nacre
