#pragma once

#include <cstddef>

namespace nacre::host {

/// What a scene may cost before it is refused. A small file can ask for much: nodes share
/// meshes, and attributes share the bytes of a buffer.
struct SceneLimits {
  std::size_t file_bytes = std::size_t{192} << 20;  ///< Of the scene's files together.
  /// Of its geometry with normals, tangents and what rays are traced against, every
  /// instance counted.
  std::size_t bytes = std::size_t{768} << 20;
  std::size_t meshes = 100'000;    ///< Drawable pieces, every instance counted.
  std::size_t values = 2'000'000;  ///< Of the JSON of a glTF file.
  int node_depth = 256;            ///< Nodes within nodes.
};

/// Largest magnitude of a coordinate, in scene units. Beyond 1.844e18 Embree leaves
/// primitives out ("rtcCommitScene", 3.13); squared distances within this stay finite.
inline constexpr float largest_coordinate = 1e18f;

/// Whether each component is a number within that.
template <class Vector>
bool is_within_reach(Vector v) {
  const auto fits = [](float x) { return x >= -largest_coordinate && x <= largest_coordinate; };
  return fits(v.x) && fits(v.y) && fits(v.z);
}

}  // namespace nacre::host
