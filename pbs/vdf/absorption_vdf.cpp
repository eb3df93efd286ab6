#include "pbs/vdf.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// absorption_vdf: absorption alone. MaterialX PBS 1.39, "absorption_vdf".
/// Coefficients below zero, and NaN, count as zero.
void record_closure_absorption_vdf(NodeCall& call) {
  auto vdf = std::make_shared<Vdf>();
  vdf->absorption = max(call.vector3("absorption"), Color3(0.0f));
  call.set(std::move(vdf));
}

}  // namespace nacre
