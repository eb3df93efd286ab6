#include "jit/graph/graph.h"

#include <fmt/format.h>

namespace nacre {

const GraphInput* GraphNode::input(std::string_view name) const {
  for (const GraphInput& candidate : inputs) {
    if (candidate.name == name) return &candidate;
  }
  return nullptr;
}

Parameter* find_parameter(Graph& graph, std::string_view path) {
  for (Parameter& parameter : graph.parameters) {
    if (parameter.path == path) return &parameter;
  }
  return nullptr;
}

}  // namespace nacre
