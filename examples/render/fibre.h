#pragma once

#include "examples/render/scene.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// A point on a fibre, in the space of its mesh: a sphere rolls along it, and this is where it
/// touches.
struct FibrePoint {
  Vec3 centre;
  Vec3 axis;    ///< Unit, from the root on.
  Vec3 normal;  ///< Unit, outwards.
  float radius = 0.f;

  Vec3 position() const { return centre + radius * normal; }
  /// Where what goes straight through comes out.
  Vec3 opposite() const { return centre - radius * normal; }
};

/// `along` in [0, 1] from the first end of the piece to the second; `normal`: unit, in the space of
/// the mesh.
FibrePoint fibre_point(const Mesh& mesh, const Triangle& piece, float along, Vec3 normal);

/// Pieces of fibres through vertices as they follow each other, `counts` of them for each fibre.
/// Fibres of one vertex have no piece.
std::vector<Triangle> fibre_pieces(const std::vector<std::uint32_t>& counts);

/// finish_mesh() for fibres: drops pieces with an end that is not finite or beyond
/// largest_coordinate, without a length, or of no radius, with one warning that counts them.
/// Returns false, with an error, when none is left.
bool finish_fibres(Mesh& mesh, const SourceLocation& where, Diagnostics& diagnostics);

}  // namespace nacre::host
