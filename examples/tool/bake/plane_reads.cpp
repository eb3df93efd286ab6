#include "examples/tool/bake/plane_reads.h"

#include <fmt/format.h>

#include <algorithm>

#include "examples/tool/bake/geometry_reads.h"

namespace nacre::tool {

namespace {

/// What the plane has of a group of channels.
std::string value_of(const std::string& group) {
  if (group == "P" || group == "Po") return "(u, v, 0)";
  if (group == "N" || group == "No" || group == "Ng") return "(0, 0, 1)";
  if (group == "T" || group == "To") return "(1, 0, 0)";
  if (group == "B" || group == "Bo") return "(0, 1, 0)";
  if (group == "wo") return "a viewer straight above every point";
  if (group.starts_with("uv")) return "the same coordinates in every set";
  return group.starts_with("geomprop.") ? "its default" : "0";
}

bool is_axis_of_frame(const std::string& group) {
  return group == "N" || group == "T" || group == "B" || group == "Ng";
}

}  // namespace

void PlaneReads::warn(const Graph& graph, const Program& program, bool in_frame,
                      const SourceLocation& where) {
  std::set<std::string> groups = groups_read(program);
  // One set of texture coordinates is what is baked; of several the relation is unknown.
  const auto is_set = [](const std::string& group) { return group.starts_with("uv"); };
  if (std::ranges::count_if(groups, is_set) == 1) std::erase_if(groups, is_set);
  if (in_frame) std::erase_if(groups, is_axis_of_frame);
  for (const GeometryRead& read : geometry_reads(graph, groups, where)) {
    if (!said_.emplace(read.group, read.path).second) continue;
    diagnostics_.warning(
        "plane-geometry", read.where,
        fmt::format("the {} read here is that of the plane baked on", attribute_name(read.group)),
        "a graph of texture coordinates alone", value_of(read.group));
  }
}

}  // namespace nacre::tool
