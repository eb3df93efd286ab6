#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "examples/bake_mesh/flat_triangle.h"
#include "examples/render/scene.h"
#include "runtime/diagnostic.h"

namespace nacre::host {

/// A square of uv from (u, v) to (u + 1, v + 1).
struct UvTile {
  int u = 0, v = 0;
  bool operator==(const UvTile&) const = default;
};

/// An image of a square of uv.
struct MapFrame {
  int width = 0, height = 0;
  UvTile tile;

  std::size_t texels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  bool operator==(const MapFrame&) const = default;
};

/// A set of texture coordinates of a mesh, by vertex; empty where it has none of that number.
std::vector<Vec2> uv_set_of(const Mesh& mesh, int number);

/// The triangles of a scene that are baked, by where a set of texture coordinates has them.
class UvLayout {
 public:
  struct Piece {
    std::uint32_t mesh, triangle;
  };

  /// Of these meshes of a scene, by index. An error for a mesh that has no such set or no triangle
  /// with an area in it; a warning counts the triangles of others that have none, or corners that
  /// are no numbers, and are left out.
  UvLayout(const Scene& scene, const std::vector<std::uint32_t>& meshes, int uv_set,
           const std::string& file, Diagnostics& diagnostics);

  /// In the order of the scene, and in a mesh of its triangles.
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Of a piece, in texels of a map, y down.
  FlatTriangle triangle(std::uint32_t piece, const MapFrame& frame) const;

  /// The squares that there are in a UDIM set, u from 0 to 9 and v from 0 to 899, and that pieces
  /// have some area in, more than `uv_rounding` wide and high, by their numbers. `outside`: how
  /// many pieces reach out of all of them.
  std::vector<UvTile> tiles(std::size_t& outside) const;
  /// How many pieces reach out of a square by more than `uv_rounding`.
  std::size_t outside(UvTile tile) const;
  static constexpr double uv_rounding = 1e-5;

  /// What people call a piece's mesh: the object, and where there are several of that name which
  /// of them, from 1, and of what material.
  std::string name_of(std::uint32_t mesh) const;

 private:
  FlatTriangle in_uv(std::uint32_t piece) const;

  const Scene& scene_;
  std::vector<std::vector<Vec2>> uv_;  ///< By mesh; of others empty.
  std::vector<Piece> pieces_;
};

}  // namespace nacre::host
