#include "pbs/displacement.h"

#include <algorithm>

#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

DisplacementPtr as_displacement(const ClosurePtr& closure) {
  return std::dynamic_pointer_cast<const Displacement>(closure);
}

/// displacement: a float along the normal, or a vector3 in the frame (tangent, bitangent,
/// normal), times `scale`; the frame is the host's, in world space. MaterialX PBS 1.39,
/// "displacement", which writes (dPdu, dPdv, N): unit vectors here, as in the data
/// library's generators, so that a vector means a length. IEEE arithmetic: what is not
/// finite stays so.
void record_closure_displacement(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const Float3 n = normal(recorder, Space::world);
  auto result = std::make_shared<Displacement>();
  const Recorded& by = call.in("displacement");
  const bool is_flat = std::all_of(by.parts.begin(), by.parts.end(),
                                   [](Ref part) { return Float(part).is_constant(0.0f); });
  if (is_flat || call.number("scale").is_constant(0.0f)) {
    // Nothing moves: no kernel, whatever the frame is.
  } else if (by.type == Type::float_) {
    result->offset = n * (call.number("displacement") * call.number("scale"));
  } else {
    const Float3 d = call.vector3("displacement") * Float3(call.number("scale"));
    result->offset = fma(Float3(d.x), tangent(recorder, Space::world),
                         fma(Float3(d.y), bitangent(recorder, Space::world), Float3(d.z) * n));
  }
  call.set(std::move(result));
}

}  // namespace nacre
