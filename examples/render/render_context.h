#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "examples/render/bvh.h"
#include "examples/render/camera.h"
#include "examples/render/media.h"
#include "examples/render/render.h"
#include "examples/render/scene_lights.h"
#include "examples/render/surface.h"

namespace nacre::host {

/// A shader as the integrator sorts by it: all points that it shades, of whatever mesh, go
/// together.
struct Material {
  const Shader* shader = nullptr;
  Capabilities capabilities;
  /// Index of what light meets from below, where it has gone there.
  std::uint32_t exit = Media::no_exit;
};

/// Everything the threads of a render share, read-only once built.
class RenderContext {
 public:
  RenderContext(const RenderInput& input, const RenderSettings& settings, Diagnostics& diagnostics);

  const Scene& scene;
  const Environment* environment;  ///< Null when black.
  RenderSettings settings;
  PixelCamera camera;
  SurfaceGeometry geometry;
  std::optional<Bvh> own_bvh;  ///< Where RenderInput has none.
  const Bvh& bvh;
  std::vector<Material> materials;
  /// By mesh, of either side: indices of `materials`.
  std::vector<std::uint32_t> front_materials, back_materials;
  bool any_opacity = false;
  bool any_matte = false;
  bool any_media = false;
  bool any_volume = false;
  bool any_nested = false;  ///< RenderInput::solids has some.
  /// The volumes and solids that the camera is inside of as the shutter opens.
  Media camera_media;
  std::vector<float> bounds;  ///< By mesh: Medium::bound of a volume that varies; else 0.
  std::vector<const LightShader*> point_lights;  ///< That no ray meets.
  SceneLights lights;
  std::size_t state_bytes = 0;  ///< Of the neediest shader at the batch size.
  std::size_t primvars = 0;     ///< Of the neediest shader.

  /// Whether a mesh is one of RenderInput::solids.
  bool is_solid(std::uint32_t mesh) const { return any_nested && solids_[mesh]; }

  /// The material of the side that `wo` is on.
  std::uint32_t material_of(const SurfacePoint& point) const {
    const std::uint32_t front = front_materials[point.mesh], back = back_materials[point.mesh];
    if (front == back) return front;
    return dot(surface_normal(scene, point), point.wo) < 0.f ? back : front;
  }

 private:
  void collect_materials(const RenderInput& input);
  std::uint32_t add_material(const Shader& shader);
  void find_bounds();

  std::vector<bool> solids_;
  std::map<const Shader*, std::uint32_t> known_;
  std::vector<std::unique_ptr<const Shader>> own_shaders_;  ///< Emitters and exits.
};

}  // namespace nacre::host
