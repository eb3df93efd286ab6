#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>
#include <vector>

#include "examples/render/camera.h"
#include "examples/render/scene.h"
#include "examples/render/shader.h"
#include "examples/render/surface.h"

namespace nacre::host {

struct DisplaceSettings {
  float edge = 1.f;  ///< Longest edge, in distances between the camera's samples.
  std::size_t most_triangles = 4'000'000;  ///< More than there are, of all meshes together.
  Clock clock;
  std::stop_token stop;  ///< Asked to: the scene is of no use then.
};

struct DisplaceResult {
  std::vector<std::uint32_t> coarse;   ///< Meshes that most_triangles kept from being fine enough.
  std::vector<std::uint32_t> stopped;  ///< Meshes that bend, and stand as the shutter opens.
  std::size_t invalid = 0;  ///< Vertices that were not moved: to nowhere, or out of reach.
};

/// Moves the surfaces of a scene before it is traced: each mesh that has a shader, which displaces,
/// is split into triangles no larger than the picture shows where they are moved to, and their
/// vertices are moved. How far that is from the eye: of what is known to be moved away, by
/// Shader::displacement_box(), the triangles may be larger; what the shader brings nearer at the
/// vertices of the first splitting is split on, to an eighth of the size at most, unless what is
/// known of it says that it is in no part of the picture: mirrors and shadows have it as it is.
/// Vertices at one place are moved together, by the mean of where they go. Normals and tangents are
/// then those of what is there; positions in object space are where the surface was, so that
/// patterns stay on it. Of what is drawn several times the instance next to the camera decides.
///
/// `shaders`: by mesh; null: stays as it is. Fibres stay.
DisplaceResult displace(Scene& scene, const std::vector<const Shader*>& shaders,
                        const PixelCamera& camera, Vec3 eye, const DisplaceSettings& settings);

}  // namespace nacre::host
