#pragma once

#include <algorithm>

#include "runtime/node/node_call.h"

namespace nacre {

/// The set that "index" names; it decides which channels a kernel reads, so it
/// must be a literal. Set 0 for anything else and for numbers below 0.
inline int set_index(const NodeCall& call) {
  const Int index = call.integer("index");
  return index.is_constant() ? std::max(index.constant(), 0) : 0;
}

}  // namespace nacre
