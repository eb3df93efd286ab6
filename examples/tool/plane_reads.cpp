#include "examples/tool/plane_reads.h"

#include <fmt/format.h>

#include <algorithm>
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

/// What a group of channels is, and what the plane has there.
std::pair<std::string, std::string> meaning(const std::string& group) {
  if (group == "P" || group == "Po") return {"position", "(u, v, 0)"};
  if (group == "N" || group == "No") return {"normal", "(0, 0, 1)"};
  if (group == "Ng") return {"geometric normal", "(0, 0, 1)"};
  if (group == "T" || group == "To") return {"tangent", "(1, 0, 0)"};
  if (group == "B" || group == "Bo") return {"bitangent", "(0, 1, 0)"};
  if (group == "wo") return {"view direction", "a viewer straight above every point"};
  if (group.starts_with("color")) return {fmt::format("vertex colour {}", group.substr(5)), "0"};
  if (group.starts_with("uv"))
    return {fmt::format("texture coordinate set {}", group.substr(2)),
            "the same coordinates in every set"};
  constexpr std::string_view property = "geomprop.";
  if (group.starts_with(property)) {
    return {fmt::format("geometric property '{}'", group.substr(property.size())), "its default"};
  }
  return {fmt::format("attribute '{}'", group), "0"};
}

bool is_axis_of_frame(const std::string& group) {
  return group == "N" || group == "T" || group == "B" || group == "Ng";
}

}  // namespace

void PlaneReads::warn(const Graph& graph, const Program& program, bool in_frame,
                      const SourceLocation& where) {
  std::set<std::string> groups;
  for (const Channel& channel : program.inputs) groups.insert(group_of(channel.name));
  // One set of texture coordinates is what is baked; of several the relation is unknown.
  const auto is_set = [](const std::string& group) { return group.starts_with("uv"); };
  if (std::ranges::count_if(groups, is_set) == 1) std::erase_if(groups, is_set);
  if (in_frame) std::erase_if(groups, is_axis_of_frame);
  std::set<std::string> unnamed = groups;
  for (const GraphNode& node : graph.nodes) {
    const std::string group = group_read_by(node);
    if (!groups.contains(group)) continue;
    unnamed.erase(group);
    warn_once(group, node.path, node.where);
  }
  for (const std::string& group : unnamed) warn_once(group, where.path, where);
}

void PlaneReads::warn_once(const std::string& group, const std::string& path,
                           const SourceLocation& where) {
  if (!said_.emplace(group, path).second) return;
  const auto [attribute, value] = meaning(group);
  diagnostics_.warning("plane-geometry", where,
                       fmt::format("the {} read here is that of the plane baked on", attribute),
                       "a graph of texture coordinates alone", value);
}

}  // namespace nacre::tool
