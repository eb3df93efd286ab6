#include "pbs/vdf.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// anisotropic_vdf: absorption and Henyey-Greenstein scattering. MaterialX PBS
/// 1.39, "anisotropic_vdf". Coefficients below zero, and NaN, count as zero.
void record_closure_anisotropic_vdf(NodeCall& call) {
  auto vdf = std::make_shared<Vdf>();
  vdf->absorption = max(call.vector3("absorption"), Color3(0.0f));
  vdf->scattering = max(call.vector3("scattering"), Color3(0.0f));
  vdf->anisotropy = clamp(call.number("anisotropy"), -1.0f, 1.0f);
  call.set(std::move(vdf));
}

}  // namespace nacre
