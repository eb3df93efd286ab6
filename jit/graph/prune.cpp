#include "jit/graph/prune.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace nacre {

namespace {

constexpr std::uint32_t dropped = std::numeric_limits<std::uint32_t>::max();

// New numbers for those marked, in order.
std::vector<std::uint32_t> renumber(const std::vector<bool>& used) {
  std::vector<std::uint32_t> numbers(used.size(), dropped);
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) numbers[i] = next++;
  }
  return numbers;
}

template <typename Item>
void compact(std::vector<Item>& items, const std::vector<std::uint32_t>& numbers) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (numbers[i] == dropped) continue;
    if (kept != i) items[kept] = std::move(items[i]);
    ++kept;
  }
  items.resize(kept);
}

}  // namespace

void prune(Graph& graph) {
  std::vector<bool> nodes(graph.nodes.size());
  std::vector<bool> parameters(graph.parameters.size());
  const auto mark = [&](const Source& source) {
    if (source.kind == Source::Kind::link) nodes[source.node] = true;
    if (source.kind == Source::Kind::parameter) parameters[source.parameter] = true;
  };
  for (const GraphOutput& output : graph.outputs) mark(output.source);
  for (std::size_t i = graph.nodes.size(); i-- > 0;) {
    if (!nodes[i]) continue;
    for (const GraphInput& input : graph.nodes[i].inputs) mark(input.source);
  }
  const std::vector<std::uint32_t> new_node = renumber(nodes);
  const std::vector<std::uint32_t> new_parameter = renumber(parameters);
  compact(graph.nodes, new_node);
  compact(graph.parameters, new_parameter);
  const auto update = [&](Source& source) {
    if (source.kind == Source::Kind::link) source.node = new_node[source.node];
    if (source.kind == Source::Kind::parameter) source.parameter = new_parameter[source.parameter];
  };
  for (GraphNode& node : graph.nodes) {
    for (GraphInput& input : node.inputs) update(input.source);
  }
  for (GraphOutput& output : graph.outputs) update(output.source);
}

}  // namespace nacre
