#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "examples/render/scene.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// What a mesh without normals looks like.
enum class MissingNormals {
  smooth,  ///< Vertex normals are made from the triangles around.
  flat,    ///< Each triangle has its own: the mesh has none, or, where it bends, such vertices.
};

/// Makes a mesh fit to trace and shade, in this order:
/// - drops triangles with an index out of range, a corner that is not finite or beyond
///   largest_coordinate, or no area, with one warning that counts them;
/// - makes normals when there are none: flat, or from the triangles around weighted by
///   corner angle (Thürmer and Wüthrich 1998);
/// - gives normals and tangents without a direction another, with a warning;
/// - turns each triangle so that its winding and its normals agree;
/// - makes tangents from uv, accumulated per vertex, when there are none.
///
/// On entry positions and normals (if any) are world space, and every vertex
/// array is empty or as long as `position`. Diagnostics stand at `where`.
/// Returns false, with an error, when no triangle is left.
bool finish_mesh(Mesh& mesh, const SourceLocation& where, Diagnostics& diagnostics,
                 MissingNormals missing = MissingNormals::smooth);

/// Of a mesh of flat faces that has no normals: gives each triangle vertices of its own, and them
/// its normal and tangent. Of others nothing changes.
void give_flat_vertices(Mesh& mesh);

/// Unit, orthogonal to n, along u where there is a map; the sign that of v.
Tangent face_tangent(const Mesh& mesh, const Triangle& triangle, Vec3 n);

/// Moves a mesh whose vertices are mesh-local to world space: keeps the local
/// positions and records the map. The winding turns when the map mirrors. Fibres stay round: their
/// radius grows as the cube root of volume.
void bake_transform(Mesh& mesh, const Affine& object_to_world);

/// The derivatives of position by uv over a triangle. False, and zeros, when
/// its uv map has no area.
bool surface_derivatives(const Mesh& mesh, const Triangle& triangle, Vec3& dPdu, Vec3& dPdv);

/// Elements of a vertex array in that order; of none none.
template <class T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<std::uint32_t>& order,
                        std::size_t components = 1) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(order.size() * components + 1);  // Embree reads it where it is: see bvh.cpp.
  for (const std::uint32_t v : order) {
    for (std::size_t c = 0; c < components; ++c) result.push_back(values[v * components + c]);
  }
  return result;
}

/// Gives each number of `order` a vertex of its own; what uses vertices is the caller's to
/// renumber.
void take_order(Mesh& mesh, const std::vector<std::uint32_t>& order);

/// Normals and tangents anew, of the triangles that meet at a place: `places` has for each vertex
/// the first one at its place.
void renew_frames(Mesh& mesh, const std::vector<std::uint32_t>& places);

/// Whether triangles bound a solid: each edge is that of two, by where its ends are, which run
/// along it in opposite directions. What enters by one leaves by another.
bool is_closed(const Mesh& mesh);

/// Of the vertices that a triangle uses, in all poses, in the space that they are in.
Bounds vertex_bounds(const Mesh& mesh);
/// World bounds of a box that moves.
Bounds instance_bounds(const Bounds& own, const Motion& motion);

}  // namespace nacre::host
