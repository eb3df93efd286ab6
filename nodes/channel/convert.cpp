#include "runtime/node/node_call.h"

namespace nacre {

/// A boolean (1 or 0) or an integer (to the nearest float) as a float. MaterialX
/// 1.39 Standard Nodes, "convert"; the data library's graphs do the other types.
/// Integers beyond 2^24 are rounded; every one is finite.
void record_convert(NodeCall& call) {
  if (call.type("in") == Type::boolean) {
    call.set(to_float(call.boolean("in")));
  } else {
    call.set(to_float(call.integer("in")));
  }
}

}  // namespace nacre
