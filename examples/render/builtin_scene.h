#pragma once

#include <string>

#include "examples/render/scene.h"

namespace nacre::host {

/// A sphere about `centre` with the poles on the y axis; u runs around from +x
/// over -z, v from the lower pole (0) to the upper (1). `steps` segments from
/// pole to pole, twice as many around.
Mesh make_sphere(const std::string& name, Vec3 centre, float radius, int steps);

/// The parallelogram corner + s·edge_u + t·edge_v, uv = (s, t); its front is the
/// side of cross(edge_u, edge_v).
Mesh make_quad(const std::string& name, Vec3 corner, Vec3 edge_u, Vec3 edge_v);

/// A quad that is an area light of this radiance, emitting from its front.
Mesh make_quad_light(const std::string& name, Vec3 corner, Vec3 edge_u, Vec3 edge_v, Vec3 radiance);

/// What `render` shows when no scene is named: objects and materials "ball" (a
/// sphere of radius 1 above y = 0), "base" (the turned pedestal it sits on) and
/// "ground" (20 by 20 at y = 0), under the area light "key". The scene has a camera.
Scene make_builtin_scene();

/// A square "ground" below `scene`, ten times as wide as the scene is.
Mesh make_ground_below(const Scene& scene);

}  // namespace nacre::host
