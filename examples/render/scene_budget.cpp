#include "examples/render/scene_budget.h"

#include <fmt/format.h>

#include "examples/render/scene.h"

namespace nacre::host {

namespace {

// Positions in both spaces, normal, tangent, uv, the copy that rays are traced against, and
// what making normals and tangents takes meanwhile.
constexpr std::size_t vertex_bytes = 112;
// Indices, their copy, and the hierarchy over them while it is built.
constexpr std::size_t triangle_bytes = 200;
// The mesh itself and its part of the hierarchy.
constexpr std::size_t mesh_bytes = sizeof(Mesh) + 2048;

std::size_t bytes_of(std::size_t vertices, std::size_t triangles, std::size_t other) {
  // Counts are of things in files of limited size, so that no sum overflows.
  return vertices * vertex_bytes + triangles * triangle_bytes + mesh_bytes + other;
}

}  // namespace

bool SceneBudget::fits(std::size_t vertices, std::size_t triangles, std::size_t other) const {
  return meshes_ < limits_.meshes && bytes_of(vertices, triangles, other) <= limits_.bytes - bytes_;
}

bool SceneBudget::take(const SourceLocation& where, std::size_t vertices, std::size_t triangles,
                       std::size_t other) {
  if (meshes_ == limits_.meshes) {
    diagnostics_.error("scene-too-large", where, "the scene has too many meshes",
                       fmt::format("at most {} with all instances (--max-meshes)", limits_.meshes));
    return false;
  }
  if (fits(vertices, triangles, other)) {
    ++meshes_;
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
