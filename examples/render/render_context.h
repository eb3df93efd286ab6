#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "examples/render/area_light.h"
#include "examples/render/bvh.h"
#include "examples/render/camera.h"
#include "examples/render/render.h"
#include "examples/render/surface.h"

namespace nacre::host {

/// A shader as the integrator sorts by it. One that needs batches of one mesh
/// has an entry per mesh.
struct Material {
  const Shader* shader = nullptr;
  Capabilities capabilities;
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
  Bvh bvh;
  AreaLights lights;
  std::vector<Material> materials;
  std::vector<std::uint32_t> material_of_mesh;
  bool any_opacity = false;
  /// Chance that light sampling asks the environment rather than the area lights.
  float environment_chance = 0.f;
  std::size_t state_bytes = 0;  ///< Of the neediest shader at the batch size.
  std::size_t primvars = 0;     ///< Of the neediest shader.

 private:
  void collect_materials(const RenderInput& input);
  void collect_lights();
  std::vector<float> triangle_luminance(std::uint32_t mesh, BatchBuffer& buffer) const;

  std::vector<std::unique_ptr<const Shader>> emitters_;
};

}  // namespace nacre::host
