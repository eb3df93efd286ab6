#include "pbs/vdf.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// anisotropic_vdf: absorption and Henyey-Greenstein scattering. MaterialX PBS
/// 1.39, "anisotropic_vdf". Coefficients as finite_coefficients has them.
void record_closure_anisotropic_vdf(NodeCall& call) {
  auto vdf = std::make_shared<Vdf>();
  vdf->absorption = finite_coefficients(call.vector3("absorption"));
  vdf->scattering = finite_coefficients(call.vector3("scattering"));
  vdf->anisotropy = clamp(call.number("anisotropy"), -1.0f, 1.0f);
  call.set(std::move(vdf));
}

}  // namespace nacre
