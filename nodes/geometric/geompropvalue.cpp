#include <string>
#include <utility>

#include "runtime/node/geometry.h"
#include "runtime/node/node_call.h"

namespace nacre {

/// The varying geometric property of that name, or `default` where the geometry
/// has none. MaterialX 1.39 Standard Nodes, "geompropvalue". The uniform slot
/// "geomprop.NAME" says whether it has (runtime/node/geometry.h); a host freezes
/// it to false for what it never supplies, and the channel is gone. Values pass as
/// they are, NaN too.
void record_geompropvalue(NodeCall& call) {
  const std::string group = "geomprop." + call.text("geomprop");
  const std::vector<Ref>& fallback = call.in("default").parts;
  if (call.text("geomprop").empty()) return call.set(fallback);
  const Ref present = call.recorder().parameter(group, Scalar::b1, 0);
  std::vector<Ref> parts;
  for (std::size_t i = 0; i < fallback.size(); ++i) {
    const Ref value =
        channel(call.recorder(), group, static_cast<int>(i), scalar_of(call.out_type()));
    parts.push_back(record(Op::select, {present, value, fallback[i]}));
  }
  call.set(std::move(parts));
}

}  // namespace nacre
