#pragma once

#include <utility>
#include <vector>

#include "runtime/node/node_call.h"

namespace nacre {

/// The components of all inputs, in the order of the nodedef, as one value.
inline void record_combine(NodeCall& call) {
  std::vector<Ref> parts;
  for (const NodeCall::Port& input : call.inputs()) {
    parts.insert(parts.end(), input.value.parts.begin(), input.value.parts.end());
  }
  call.set(std::move(parts));
}

}  // namespace nacre
