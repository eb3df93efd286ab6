#include <utility>

#include "runtime/node/node_call.h"

namespace nacre {

/// in . lumacoeffs in all colour channels; alpha passes. MaterialX 1.39 Standard
/// Nodes, "luminance". Nothing is limited: negative colours have negative
/// luminance. Edges: IEEE, see nodes/math/safe.h.
void record_luminance(NodeCall& call) {
  const Float grey = dot(call.vector3("in"), call.vector3("lumacoeffs"));
  std::vector<Ref> parts(3, grey.ref());
  if (call.out_type() == Type::color4) parts.push_back(call.in("in").parts[3]);
  call.set(std::move(parts));
}

}  // namespace nacre
