#pragma once

#include <cstddef>
#include <string>

#include "examples/render/scene.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// Makes a mesh fit to trace and shade, in this order:
/// - drops triangles with an index out of range, a non-finite corner or no
///   area, with one warning that counts them;
/// - makes normals from the triangles, weighted by corner angle (Thürmer and
///   Wüthrich 1998), when there are none;
/// - turns each triangle so that its winding and its normals agree;
/// - makes tangents from uv, accumulated per vertex, when there are none.
///
/// On entry positions and normals (if any) are world space, and every vertex
/// array is empty or as long as `position`.
/// Returns false, with an error, when no triangle is left.
bool finish_mesh(Mesh& mesh, const std::string& file, Diagnostics& diagnostics);

/// Moves a mesh whose vertices are mesh-local to world space: keeps the local
/// positions and records the map. The winding turns when the map mirrors.
void bake_transform(Mesh& mesh, const Affine& object_to_world);

/// The derivatives of position by uv over a triangle. False, and zeros, when
/// its uv map has no area.
bool surface_derivatives(const Mesh& mesh, const Triangle& triangle, Vec3& dPdu, Vec3& dPdv);

}  // namespace nacre::host
