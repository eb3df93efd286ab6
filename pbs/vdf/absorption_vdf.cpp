#include "pbs/vdf.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// absorption_vdf: absorption alone. MaterialX PBS 1.39, "absorption_vdf".
/// Coefficients as finite_coefficients has them.
void record_closure_absorption_vdf(NodeCall& call) {
  auto vdf = std::make_shared<Vdf>();
  vdf->absorption = finite_coefficients(call.vector3("absorption"));
  call.set(std::move(vdf));
}

}  // namespace nacre
