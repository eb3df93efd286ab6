#pragma once

#include <random>

#include "examples/render/builtin_scene.h"
#include "examples/render/mesh.h"
#include "examples/render/scene.h"

namespace nacre::host {

/// Triangles at random places of uv and of space, three vertices each.
inline Mesh random_triangles(int count, unsigned seed, float spread = 1.0f) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  Mesh mesh;
  mesh.object_name = "random";
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    const Vec2 middle{spread * unit(random), spread * unit(random)};
    for (int c = 0; c < 3; ++c) {
      mesh.position.push_back({unit(random), unit(random), unit(random)});
      mesh.uv.push_back(middle + Vec2{0.2f * unit(random), 0.2f * unit(random)});
    }
    mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}});
  }
  Diagnostics ignored;
  finish_mesh(mesh, {}, ignored);
  return mesh;
}

inline Scene scene_of(Mesh mesh) {
  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

}  // namespace nacre::host
