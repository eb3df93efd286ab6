#pragma once

#include <utility>
#include <vector>

#include "runtime/node/node_call.h"

namespace nacre {

/// Sets in1 where the condition holds, else in2; the condition itself for the
/// nodedefs that have neither.
inline void choose(NodeCall& call, Bool condition) {
  if (!call.has("in1")) return call.set(condition);
  const std::vector<Ref>& held = call.in("in1").parts;
  const std::vector<Ref>& otherwise = call.in("in2").parts;
  std::vector<Ref> parts;
  for (std::size_t i = 0; i < held.size(); ++i) {
    parts.push_back(record(Op::select, {condition.ref(), held[i], otherwise[i]}));
  }
  call.set(std::move(parts));
}

}  // namespace nacre
