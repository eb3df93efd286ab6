#include "examples/tool/render/missing_attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace nacre::tool {

namespace {

/// An attribute, and what is taken where there is none.
using Missing = std::pair<std::string, std::string>;

std::vector<Missing> missing_of(const host::Mesh& mesh, const KernelShader& shader) {
  std::vector<Missing> list;
  if (mesh.uv.empty() && shader.reads_uv()) list.emplace_back("texture coordinates", "zeros");
  const host::Capabilities can = shader.capabilities();
  if (mesh.uv.empty() && (can.attributes & host::attribute_tangents) != 0) {
    list.emplace_back("tangents", "any direction along the surface");
  }
  for (const host::PrimvarRequest& wanted : can.primvars) {
    const bool has = std::any_of(mesh.primvars.begin(), mesh.primvars.end(),
                                 [&](const host::Primvar& p) { return p.name == wanted.name; });
    if (!has) list.emplace_back(wanted.name, "the node's default, or zeros");
  }
  return list;
}

}  // namespace

void report_missing_attributes(const std::vector<ShadedMesh>& meshes, const std::string& scene_file,
                               Diagnostics& diagnostics) {
  struct Found {
    std::string first_mesh;
    std::size_t count = 0;
  };
  std::map<std::pair<std::string, Missing>, Found> all;
  for (const ShadedMesh& each : meshes) {
    for (Missing& missing : missing_of(*each.mesh, *each.shader)) {
      Found& found = all[{each.material, std::move(missing)}];
      if (found.count++ == 0) found.first_mesh = each.mesh->object_name;
    }
  }
  for (const auto& [what, found] : all) {
    const auto& [material, missing] = what;
    diagnostics.warning(
        "missing-attribute", {scene_file, 0, 0, found.first_mesh},
        fmt::format("material '{}' reads {}, which {} not have: {} are taken", material,
                    missing.first,
                    found.count == 1 ? "the mesh does" : fmt::format("{} meshes do", found.count),
                    missing.second));
  }
}

}  // namespace nacre::tool
