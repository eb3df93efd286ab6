#include "pbs/surface.h"

#include "runtime/node/node_call.h"

namespace nacre {

SurfacePtr as_surface(const ClosurePtr& closure) {
  return std::dynamic_pointer_cast<const Surface>(closure);
}

/// surface: a BSDF, an EDF and a presence. MaterialX PBS 1.39, "surface".
/// opacity is clamped to [0, 1]; NaN counts as 0.
void record_closure_surface(NodeCall& call) {
  auto surface = std::make_shared<Surface>();
  surface->bsdf = as_bsdf(call.closure("bsdf"));
  surface->edf = as_edf(call.closure("edf"));
  surface->opacity = saturate(call.number("opacity"));
  surface->thin_walled = keep(call.recorder(), call.boolean("thin_walled"));
  call.set(std::move(surface));
}

}  // namespace nacre
