#include "examples/render/scene_budget.h"

#include <fmt/format.h>

#include "examples/render/bvh.h"
#include "examples/render/scene.h"

namespace nacre::host {

namespace {

// Positions in both spaces, normal, tangent, uv, and what making normals and tangents takes
// meanwhile.
constexpr std::size_t vertex_bytes = 100;
// Indices, and the hierarchy over them while it is built.
constexpr std::size_t triangle_bytes = 200, compact_triangle_bytes = 80;
// The mesh itself and its part of the hierarchy.
constexpr std::size_t mesh_bytes = sizeof(Mesh) + 2048;

// Of an instance: Embree's geometry and its part of the hierarchy, and matrices, ours and Embree's.
constexpr std::size_t segment_bytes = 2048;
constexpr std::size_t step_bytes = 160;
// Of one that stands still: room for Embree's geometry and its matrix, and ours.
constexpr std::size_t still_instance_bytes = 640;

std::size_t bytes_of(std::size_t vertices, std::size_t triangles, std::size_t other) {
  // Counts are of things in files of limited size, so that no sum overflows.
  const bool is_compact = triangles > compact_triangles;
  return vertices * vertex_bytes + mesh_bytes + other +
         triangles * (is_compact ? compact_triangle_bytes : triangle_bytes);
}

}  // namespace

bool SceneBudget::fits(std::size_t vertices, std::size_t triangles, std::size_t other) const {
  return meshes_ < limits_.meshes && bytes_of(vertices, triangles, other) <= limits_.bytes - bytes_;
}

bool SceneBudget::take_mesh(const SourceLocation& where) {
  if (meshes_ < limits_.meshes) return ++meshes_, true;
  diagnostics_.error("scene-too-large", where, "the scene has too many meshes",
                     fmt::format("at most {} with all instances (--max-meshes)", limits_.meshes));
  return false;
}

bool SceneBudget::take_bytes(const SourceLocation& where, std::size_t bytes) {
  if (bytes <= limits_.bytes - bytes_) return bytes_ += bytes, true;
  diagnostics_.error(
      "scene-too-large", where, "the scene takes too much memory",
      fmt::format("at most {} bytes with all instances (--max-scene-size)", limits_.bytes),
      fmt::format("{} before these {}", bytes_, bytes));
  return false;
}

bool SceneBudget::take_instance(const SourceLocation& where, bool is_first, std::size_t segments,
                                std::size_t steps) {
  const std::size_t bytes =
      steps > 1 ? segments * segment_bytes + steps * step_bytes : still_instance_bytes;
  return (is_first || take_mesh(where)) && take_bytes(where, bytes);
}

bool SceneBudget::take(const SourceLocation& where, std::size_t vertices, std::size_t triangles,
                       std::size_t other) {
  if (!take_mesh(where)) return false;
  if (bytes_of(vertices, triangles, other) <= limits_.bytes - bytes_) {
    bytes_ += bytes_of(vertices, triangles, other);
    return true;
  }
  diagnostics_.error(
      "scene-too-large", where, "the geometry of the scene takes too much memory",
      fmt::format("at most {} bytes with all instances (--max-scene-size)", limits_.bytes),
      fmt::format("{} before this mesh of {} vertices and {} triangles", bytes_, vertices,
                  triangles));
  return false;
}

}  // namespace nacre::host
