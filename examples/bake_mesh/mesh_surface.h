#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "examples/bake/bake.h"
#include "examples/bake_mesh/texel_cover.h"
#include "examples/bake_mesh/transport.h"
#include "examples/render/scene.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// What of a scene is baked, and how.
struct MeshRequest {
  std::string file = {};                 ///< That the scene is of, for what is said.
  std::vector<std::string> meshes = {};  ///< Objects, meshes or paths by name; none: all.
  int uv_set = 0;                        ///< By which set of texture coordinates.
  TransportSettings transport = {};
};

/// Geometric properties that a mesh has without the file's saying: how light gets to it. What the
/// file has under such a name counts before.
///
///   ambientocclusion  float, 0 to 1          Openness::ambient
///   bentnormal        vector3, unit, world   Openness::bent
///   curvature         float, 1/unit, world   mean_curvature()
///   thickness         float, units, world    thickness()
///
/// Rays meet all of the scene.
bool is_transport_property(std::string_view name);

/// Meshes of a scene as they lie in maps by their texture coordinates. Points have what
/// SurfaceGeometry gives, of instances at the first place, and footprints that are exact for their
/// triangle: a map's texel and no viewer's.
class MeshSurface : public BakeSurface {
 public:
  /// Null after an error: no such mesh, or nothing laid out. What cannot be baked, and was not
  /// asked for by name, is a warning.
  static std::unique_ptr<MeshSurface> make(Scene scene, MeshRequest request,
                                           Diagnostics& diagnostics);
  ~MeshSurface() override;

  const Scene& scene() const { return scene_; }
  /// ShaderOptions::varying of kernels for it: matrices, and presences of properties.
  std::vector<std::string> varying() const;
  /// Whether a mesh has a vertex attribute (PrimvarRequest) or such a transport property.
  bool has_property(std::string_view name) const;
  /// Whether all of them have that set.
  bool has_uv_set(int number) const;
  /// The squares of a UDIM set that it is in; an error where there are none, or more than
  /// `most_tiles`, a warning where some of it is in none.
  std::vector<UvTile> tiles(Diagnostics& diagnostics) const;
  static constexpr std::size_t most_tiles = 1000;

  /// How many triangles reach out of a square of uv, by more than exporters round.
  std::size_t outside(UvTile tile) const { return layout_->outside(tile); }

  /// Before a kernel is baked: computes what it reads and nothing else has. False after an error.
  bool prepare(const Program& program, Diagnostics& diagnostics);
  /// Before a map is baked: false, with an error, where there is nothing in it, or more than
  /// `most_depth` pieces are over each other; a warning for overlaps. Each map is looked at once.
  bool lay_out(const MapFrame& frame, Diagnostics& diagnostics);
  static constexpr double most_depth = 256.0;

  std::unique_ptr<SurfacePoints> points(const BakeSettings& settings,
                                        const Program& program) const override;

 private:
  friend class MeshPoints;

  MeshSurface(Scene scene, MeshRequest request);
  bool choose(Diagnostics& diagnostics);
  bool look_at(const MapFrame& frame, Diagnostics& diagnostics) const;
  std::shared_ptr<const RowIndex> rows_of(const MapFrame& frame) const;

  Scene scene_;
  MeshRequest request_;
  std::vector<std::uint32_t> meshes_;  ///< That are baked.
  std::unique_ptr<UvLayout> layout_;
  std::unique_ptr<Bvh> bvh_;                      ///< Where rays are asked for.
  std::vector<std::vector<float>> curvature_;     ///< By mesh and vertex, likewise.
  std::vector<std::pair<MapFrame, bool>> known_;  ///< That were laid out, and how that ended.
  mutable std::mutex mutex_;                      ///< Of the next.
  mutable std::shared_ptr<const RowIndex> rows_;  ///< Of the map that is baked.
};

}  // namespace nacre::host
