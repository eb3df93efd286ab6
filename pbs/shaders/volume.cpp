#include "pbs/volume.h"

#include "runtime/node/node_call.h"

namespace nacre {

VolumePtr as_volume(const ClosurePtr& closure) {
  return std::dynamic_pointer_cast<const Volume>(closure);
}

/// volume: a VDF and an EDF; see there for their edges. MaterialX PBS 1.39, "volume".
void record_closure_volume(NodeCall& call) {
  auto volume = std::make_shared<Volume>();
  volume->vdf = as_vdf(call.closure("vdf"));
  volume->edf = as_edf(call.closure("edf"));
  call.set(std::move(volume));
}

}  // namespace nacre
