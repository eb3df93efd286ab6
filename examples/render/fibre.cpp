#include "examples/render/fibre.h"

#include <fmt/format.h>

#include "examples/render/scene_limits.h"

namespace nacre::host {

namespace {

bool is_usable(const Mesh& mesh, const Triangle& piece) {
  for (const std::uint32_t v : piece.v) {
    if (!is_within_reach(mesh.position[v])) return false;
    if (!(mesh.radius[v] > 0.f && mesh.radius[v] <= largest_coordinate)) return false;
  }
  const Vec3 way = mesh.position[piece.v[1]] - mesh.position[piece.v[0]];
  return way.x != 0.f || way.y != 0.f || way.z != 0.f;
}

}  // namespace

FibrePoint fibre_point(const Mesh& mesh, const Triangle& piece, float along, Vec3 normal) {
  const Vec3 a = mesh.position[piece.v[0]], b = mesh.position[piece.v[1]];
  return {.centre = (1.f - along) * a + along * b,
          .axis = normalize(b - a),
          .normal = normal,
          .radius = (1.f - along) * mesh.radius[piece.v[0]] + along * mesh.radius[piece.v[1]]};
}

std::vector<Triangle> fibre_pieces(const std::vector<std::uint32_t>& counts) {
  std::vector<Triangle> pieces;
  std::uint32_t first = 0;
  for (const std::uint32_t count : counts) {
    for (std::uint32_t k = 0; k + 1 < count; ++k) {
      pieces.push_back({{first + k, first + k + 1, first + k + 1}});
    }
    first += count;
  }
  return pieces;
}

bool finish_fibres(Mesh& mesh, const SourceLocation& where, Diagnostics& diagnostics) {
  const std::string called = mesh.object_name.empty() ? "a mesh" : '\'' + mesh.object_name + '\'';
  const std::size_t dropped =
      std::erase_if(mesh.triangles, [&](const Triangle& piece) { return !is_usable(mesh, piece); });
  if (dropped != 0) {
    diagnostics.warning(
        "bad-fibres", where,
        fmt::format("{} pieces of the fibres of {} cannot be traced and were left out", dropped,
                    called),
        fmt::format("two ends, at most {:g} from 0, and a radius above 0", largest_coordinate));
  }
  // Nothing of a fibre is of a surface.
  mesh.normal.clear();
  mesh.tangent.clear();
  if (!mesh.triangles.empty()) return true;
  diagnostics.error("empty-mesh", where, called + " has no fibre",
                    "at least one piece with a length and a radius");
  return false;
}

}  // namespace nacre::host
