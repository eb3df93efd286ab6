#pragma once

#include <utility>

#include "runtime/node/node_call.h"

namespace nacre {

/// Applies a function to the colour of `in`; alpha passes.
template <class F>
void record_colour(NodeCall& call, F&& f) {
  const Float3 result = f(call.vector3("in"));
  std::vector<Ref> parts{result.x.ref(), result.y.ref(), result.z.ref()};
  if (call.out_type() == Type::color4) parts.push_back(call.in("in").parts[3]);
  call.set(std::move(parts));
}

}  // namespace nacre
