#include "examples/tool/bake/geometry_reads.h"

#include <fmt/format.h>

#include <string_view>

#include "runtime/channel/channel_name.h"

namespace nacre::tool {

namespace {

/// "P" of the channel "P.x", and of "dPdx.y", its derivative.
std::string group_of(std::string_view channel) {
  const std::string_view group = parse_channel(channel).group;
  const auto derivative = parse_derivative(group);
  return std::string(derivative ? derivative->group : group);
}

std::string text_of(const GraphNode& node, std::string_view name) {
  const GraphInput* input = node.input(name);
  return input == nullptr || input->source.value.texts.empty() ? ""
                                                               : input->source.value.texts.front();
}

int index_of(const GraphNode& node) {
  const GraphInput* input = node.input("index");
  return input == nullptr || input->source.value.ints.empty() ? 0
                                                              : input->source.value.ints.front();
}

/// The channels that a geometric node reads (runtime/node/geometry.h), "" for others.
std::string group_read_by(const GraphNode& node) {
  const auto in_space = [&](const char* world) {
    return text_of(node, "space") == "world" ? std::string(world) : std::string(world) + 'o';
  };
  if (node.category == "position") return in_space("P");
  if (node.category == "normal") return in_space("N");
  if (node.category == "tangent") return in_space("T");
  if (node.category == "bitangent") return in_space("B");
  if (node.category == "viewdirection") return "wo";
  if (node.category == "texcoord") return fmt::format("uv{}", index_of(node));
  if (node.category == "geomcolor") return fmt::format("color{}", index_of(node));
  if (node.category == "geompropvalue") return "geomprop." + text_of(node, "geomprop");
  return {};
}

}  // namespace

std::set<std::string> groups_read(const Program& program) {
  std::set<std::string> groups;
  for (const Channel& channel : program.inputs) groups.insert(group_of(channel.name));
  return groups;
}

std::vector<GeometryRead> geometry_reads(const Graph& graph, const std::set<std::string>& groups,
                                         const SourceLocation& output) {
  std::vector<GeometryRead> reads;
  std::set<std::string> unnamed = groups;
  for (const GraphNode& node : graph.nodes) {
    const std::string group = group_read_by(node);
    if (!groups.contains(group)) continue;
    unnamed.erase(group);
    reads.push_back({group, node.path, node.where});
  }
  for (const std::string& group : unnamed) reads.push_back({group, output.path, output});
  return reads;
}

std::string attribute_name(const std::string& group) {
  if (group == "P" || group == "Po") return "position";
  if (group == "N" || group == "No") return "normal";
  if (group == "Ng") return "geometric normal";
  if (group == "T" || group == "To") return "tangent";
  if (group == "B" || group == "Bo") return "bitangent";
  if (group == "wo") return "view direction";
  if (group.starts_with("color")) return fmt::format("vertex colour {}", group.substr(5));
  if (group.starts_with("uv")) return fmt::format("texture coordinate set {}", group.substr(2));
  constexpr std::string_view property = "geomprop.";
  if (group.starts_with(property)) {
    return fmt::format("geometric property '{}'", group.substr(property.size()));
  }
  return fmt::format("attribute '{}'", group);
}

}  // namespace nacre::tool
