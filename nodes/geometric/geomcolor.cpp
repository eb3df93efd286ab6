#include <string>
#include <utility>

#include "nodes/geometric/index.h"
#include "runtime/node/geometry.h"

namespace nacre {

/// The colour of the vertices, set `index`; its first component for a float.
/// MaterialX 1.39 Standard Nodes, "geomcolor". Passes as the host supplies it: not
/// limited, NaN too.
void record_geomcolor(NodeCall& call) {
  const std::string group = "color" + std::to_string(set_index(call));
  std::vector<Ref> parts;
  for (int i = 0; i < component_count(call.out_type()); ++i) {
    parts.push_back(channel(call.recorder(), group, i));
  }
  call.set(std::move(parts));
}

}  // namespace nacre
