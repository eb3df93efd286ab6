#pragma once

#include <memory>
#include <string>
#include <vector>

#include "examples/bake/dilate.h"
#include "examples/bake_mesh/mesh_surface.h"
#include "examples/render/scene_limits.h"
#include "examples/tool/bake/manifest.h"
#include "examples/tool/bake/udim.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// What the command line says of meshes to bake on.
struct MeshOptions {
  static constexpr int most_dilation = 1024;

  std::string scene;  ///< --scene: a file, "builtin", or "" for the plane.
  std::vector<std::string> meshes;
  int uv_set = 0;
  std::string view = "none";   ///< Or "normal".
  std::string dilate = "all";  ///< Or a number of texels.
  host::TransportSettings transport;
  host::SceneLimits limits;

  void add(CLI::App& command);

  bool is_viewed() const { return scene.empty() || view == "normal"; }
  /// False, with an error, if --dilate cannot be understood.
  bool read(host::Dilation& dilation, Diagnostics& diagnostics) const;
  /// As it stands at a time, in seconds. Null for the plane, and after an error.
  std::unique_ptr<host::MeshSurface> open(float time, Diagnostics& diagnostics) const;
  /// Adds to a manifest what maps of that surface depend on.
  void describe(const host::MeshSurface& surface, BakeManifest& manifest) const;
};

/// What --udim says, see read_tiles, of meshes: "auto" are the tiles that they are in; of others
/// that are not asked for there is a warning.
std::vector<UdimTile> read_tiles(std::string_view text, const host::MeshSurface& surface,
                                 const std::string& scene, Diagnostics& diagnostics);

}  // namespace nacre::tool
