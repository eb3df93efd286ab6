#include "examples/tool/bake/target.h"

#include <fmt/format.h>

#include "examples/render/batch_channels.h"
#include "examples/tool/bake/geometry_reads.h"

namespace nacre::tool {

namespace {

/// Whether every mesh has what a group of channels is; of properties whether any has.
bool has(const host::MeshSurface& surface, const std::string& group) {
  const std::string name = host::primvar_name(group);
  if (group.starts_with("uv")) return surface.has_uv_set(std::atoi(group.c_str() + 2));
  if (group.starts_with("color") || group.starts_with("geomprop.")) {
    return surface.has_property(name);
  }
  return true;
}

}  // namespace

void BakeTarget::prepare(ShaderOptions& shader) const {
  if (surface_ != nullptr) shader.varying = surface_->varying();
}

bool BakeTarget::prepare(const Graph& graph, const Program& program, bool in_frame,
                         const SourceLocation& where) {
  if (surface_ == nullptr) {
    plane_reads_.warn(graph, program, in_frame, where);
    return true;
  }
  return check_reads(graph, program, where) && surface_->prepare(program, diagnostics_);
}

bool BakeTarget::check_reads(const Graph& graph, const Program& program,
                             const SourceLocation& where) {
  std::set<std::string> groups = groups_read(program);
  std::erase_if(groups, [&](const std::string& group) {
    return group == "wo" ? is_viewed_ : has(*surface_, group);
  });
  bool is_right = true;
  for (const GeometryRead& read : geometry_reads(graph, groups, where)) {
    const bool is_view = read.group == "wo";
    is_right = is_right && !is_view;
    if (!said_.emplace(read.group, read.path).second) continue;
    if (is_view) {
      diagnostics_.error("view-dependent", read.where,
                         "a texture has no viewer, whose direction is read here",
                         "a graph of the surface alone, or --view normal");
    } else {
      diagnostics_.warning(
          "missing-attribute", read.where,
          fmt::format("the meshes do not have the {} read here: {}", attribute_name(read.group),
                      read.group.starts_with("geomprop.") ? "the node's default is taken"
                                                          : "zeros are taken"));
    }
  }
  return is_right;
}

bool BakeTarget::lay_out(const host::BakeSettings& map) {
  if (surface_ == nullptr) return true;
  return surface_->lay_out({map.width, map.height, {map.corner_u, map.corner_v}}, diagnostics_);
}

}  // namespace nacre::tool
