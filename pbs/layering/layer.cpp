#include "pbs/bsdf.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// layer: top over base, base scaled by what top lets pass. MaterialX PBS 1.39,
/// "layer". Energy-conserving, not reciprocal: the scale depends on wo alone. A VDF as base is a
/// medium behind the interface, which surface kernels leave to the renderer: the
/// top is what remains, and the kernels' manifest says so.
void record_closure_layer(NodeCall& call) {
  const ClosurePtr& base = call.closure("base");
  call.set(std::make_shared<LayerBsdf>(as_bsdf(call.closure("top")), as_bsdf(base), as_vdf(base)));
}

}  // namespace nacre
