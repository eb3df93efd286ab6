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
  Vec3 wo = {};            ///< World, unit, away from the surface.
  /// Seen straight from the camera at this distance: exact ray differentials.
  bool from_camera = false;
  float distance = 0.f;
  /// Otherwise the diameter of the cone of the path, in scene units.
  float width = 0.f;
  std::uint32_t instance = 0;  ///< As Hit.
  float time = 0.f;            ///< As Ray.
  Vec3 normal = {};            ///< As Hit.
  /// N as the mesh has it, wherever wo is: of what is moved and not yet seen.
  bool keeps_normal = false;
};

/// A point within a mesh.
struct InnerPoint {
  std::uint32_t mesh = 0, instance = 0;
  float time = 0.f;  ///< As Ray.
  Vec3 P;            ///< World.
  Vec3 wo;           ///< World, unit: where the ray through it comes from.
};

/// World position, by interpolation, so that offset_point() may be used on it.
Vec3 surface_position(const Scene& scene, const SurfacePoint& point);

/// World geometric normal, unit, on the front side.
Vec3 surface_normal(const Scene& scene, const SurfacePoint& point);

/// Seconds and frame of the scene at a time of a ray, 0 to 1.
struct Clock {
  float time = 0.f, frame = 1.f;  ///< At the moment that the shutter's times are counted from.
  float open = 0.f, close = 0.f;  ///< Seconds from there.
  float fps = 24.f;

  float time_at(float share) const { return time + shift(share); }
  float frame_at(float share) const { return frame + fps * shift(share); }

 private:
  float shift(float share) const { return (1.f - share) * open + share * close; }
};

/// Turns points into what a shader reads.
class SurfaceGeometry {
 public:
  explicit SurfaceGeometry(const Scene& scene, const Clock& clock = {});

  /// Fills `buffer.batch` for as many points as given (at most its capacity):
  /// the standing attributes and those that `needs` asks for.
  void fill(std::span<const SurfacePoint> points, const Capabilities& needs,
            const PixelCamera& camera, BatchBuffer& buffer) const;

  /// The same of points within, for volumes: of a surface there is nothing.
  void fill_within(std::span<const InnerPoint> points, const Capabilities& needs,
                   const PixelCamera& camera, BatchBuffer& buffer) const;

 private:
  void fetch_triangles(std::span<const SurfacePoint> points) const;
  void fill_position(std::span<const SurfacePoint>, bool object_space, BatchBuffer&) const;
  void fill_tangents(std::span<const SurfacePoint>, bool object_space, BatchBuffer&) const;
  void fill_derivatives(std::span<const SurfacePoint>, std::uint32_t attributes, const PixelCamera&,
                        BatchBuffer&) const;
  void fill_primvars(std::span<const SurfacePoint>, const Capabilities&, BatchBuffer&) const;
  void fill_matrices(std::span<const SurfacePoint>, std::uint32_t entries, BatchBuffer&) const;

  void fill_times(std::span<const SurfacePoint>, BatchBuffer&) const;
  void find_fibres(std::span<const SurfacePoint>, BatchBuffer&) const;
  void find_poses(std::span<const SurfacePoint>, BatchBuffer&) const;
  const Pose& pose(const SurfacePoint&, std::size_t i, const BatchBuffer&) const;

  const Scene& scene_;
  Clock clock_;
  bool has_instances_ = false;
  bool has_fibres_ = false;
  std::vector<Pose> baked_;  ///< By mesh; of those without instances.
};

}  // namespace nacre::host
