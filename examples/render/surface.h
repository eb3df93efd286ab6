#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "examples/render/batch_buffer.h"
#include "examples/render/camera.h"
#include "examples/render/scene.h"
#include "examples/render/shader.h"

namespace nacre::host {

/// A point on a mesh and how it is looked at.
struct SurfacePoint {
  std::uint32_t mesh = 0, triangle = 0;
  float u = 0.f, v = 0.f;  ///< Barycentric, as Hit.
  Vec3 wo;                 ///< World, unit, away from the surface.
  /// Seen straight from the camera at this distance: exact ray differentials.
  bool from_camera = false;
  float distance = 0.f;
  /// Otherwise the diameter of the cone of the path, in scene units.
  float width = 0.f;
};

/// World position, by interpolation, so that offset_point() may be used on it.
Vec3 surface_position(const Mesh& mesh, std::uint32_t triangle, float u, float v);

/// World geometric normal, unit, on the front side.
Vec3 surface_normal(const Mesh& mesh, std::uint32_t triangle);

/// Turns points into what a shader reads.
class SurfaceGeometry {
 public:
  explicit SurfaceGeometry(const Scene& scene);

  /// Fills `buffer.batch` for as many points as given (at most its capacity):
  /// the standing attributes and those that `needs` asks for.
  void fill(std::span<const SurfacePoint> points, const Capabilities& needs,
            const PixelCamera& camera, BatchBuffer& buffer) const;

 private:
  void fill_position(std::span<const SurfacePoint>, bool object_space, BatchBuffer&) const;
  void fill_tangents(std::span<const SurfacePoint>, bool object_space, BatchBuffer&) const;
  void fill_derivatives(std::span<const SurfacePoint>, std::uint32_t attributes, const PixelCamera&,
                        BatchBuffer&) const;
  void fill_primvars(std::span<const SurfacePoint>, const Capabilities&, BatchBuffer&) const;
  void fill_matrices(std::span<const SurfacePoint>, std::uint32_t entries, BatchBuffer&) const;

  const Scene& scene_;
  std::vector<Affine> world_to_object_;
};

}  // namespace nacre::host
