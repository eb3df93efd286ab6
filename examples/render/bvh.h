#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "examples/render/scene.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

struct Ray {
  Vec3 origin;
  Vec3 direction;                ///< Unit length.
  float far = INFINITY;          ///< Hits at or beyond do not count.
  std::uint32_t kind = ray_any;  ///< RayKind: meshes that none of the bits see do not count.
  float time = 0.f;              ///< 0: the shutter opens, 1: it closes.
};

struct Hit {
  static constexpr std::uint32_t none = ~0u;
  std::uint32_t mesh = none;
  std::uint32_t triangle = none;
  float u = 0.f, v = 0.f;  ///< P = (1-u-v) p0 + u p1 + v p2.
  float distance = 0.f;
  std::uint32_t instance = 0;  ///< Of the mesh; 0 of one that is baked.
  /// Of a fibre, unit, in the space of the mesh; u is along it then, and v 0.
  Vec3 normal = {};

  bool missed() const { return mesh == none; }
};

/// Whether a ray has an origin within largest_coordinate, a direction of about unit length and
/// an end that is a number: others make Embree's traversal run off its tree.
bool is_traceable(const Ray& ray);

/// Scenes of more triangles have a hierarchy that is as small as can be, 55 bytes a triangle less,
/// rather than as fast: rays take a third longer. Below that the default limit of a scene's size
/// leaves room for the fast one.
inline constexpr std::size_t compact_triangles = 3'000'000;

/// Embree's ray tracing over the triangles and fibres of a scene, robust (watertight) mode. A ray
/// that is not traceable meets nothing. Instances are Embree's, with the steps of their motion,
/// and one for each segment of it.
class Bvh {
 public:
  /// Reads the scene's triangles and vertices where they are: they stay there as long. `ok` is
  /// false, with an error, when memory ran out.
  Bvh(const Scene& scene, Diagnostics& diagnostics);
  ~Bvh();
  Bvh(const Bvh&) = delete;
  Bvh& operator=(const Bvh&) = delete;

  bool ok() const;

  /// The nearest hit of each ray. `coherent`: neighbours in the span are neighbours in space.
  void intersect(std::span<const Ray> rays, std::span<Hit> hits, bool coherent) const;

  /// 1 where anything is between origin and far, else 0.
  void occluded(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace nacre::host
