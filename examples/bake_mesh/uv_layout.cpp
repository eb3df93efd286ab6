#include "examples/bake_mesh/uv_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nacre::host {

namespace {

constexpr int most_u = 10, most_v = 900;

bool is_finite(Vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); }

FlatPlace place(Vec2 uv) { return {static_cast<double>(uv.x), static_cast<double>(uv.y)}; }

/// Whether it is as large as a map shows, with numbers to compute with.
bool has_area(const std::vector<Vec2>& uv, const Triangle& t) {
  const Vec2 a = uv[t.v[0]], b = uv[t.v[1]], c = uv[t.v[2]];
  if (!is_finite(a) || !is_finite(b) || !is_finite(c)) return false;
  return FlatTriangle(place(a), place(b), place(c)).area() > 1e-30;
}

}  // namespace

std::vector<Vec2> uv_set_of(const Mesh& mesh, int number) {
  if (number == 0) return mesh.uv;
  const std::string name = fmt::format("texcoord{}", number);
  const auto found = std::ranges::find(mesh.primvars, name, &Primvar::name);
  if (found == mesh.primvars.end() || found->components < 2) return {};
  const auto stride = static_cast<std::size_t>(found->components);
  std::vector<Vec2> uv;
  for (std::size_t i = 0; i + 1 < found->values.size(); i += stride) {
    uv.push_back({found->values[i], found->values[i + 1]});
  }
  return uv;
}

UvLayout::UvLayout(const Scene& scene, const std::vector<std::uint32_t>& meshes, int uv_set,
                   const std::string& file, Diagnostics& diagnostics)
    : scene_(scene), uv_(scene.meshes.size()) {
  for (const std::uint32_t m : meshes) {
    const Mesh& mesh = scene.meshes[m];
    const SourceLocation where{file, 0, 0, name_of(m)};
    uv_[m] = uv_set_of(mesh, uv_set);
    if (uv_[m].empty()) {
      diagnostics.error("no-uv", where, "the mesh has no texture coordinates to be baked by",
                        fmt::format("texture coordinate set {}, or --mesh with others", uv_set));
      continue;
    }
    const std::size_t before = pieces_.size();
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (has_area(uv_[m], mesh.triangles[t])) pieces_.push_back({m, t});
    }
    const std::size_t lost = mesh.triangles.size() - (pieces_.size() - before);
    if (lost == 0) continue;
    if (lost == mesh.triangles.size()) {
      diagnostics.error("no-uv", where, "no triangle of the mesh has an area in uv",
                        fmt::format("a texture coordinate set {} that is laid out", uv_set));
    } else {
      diagnostics.warning("flat-uv", where,
                          fmt::format("{} of {} triangles have no area in uv and are not baked",
                                      lost, mesh.triangles.size()),
                          "texture coordinates that are finite and not in a line");
    }
  }
}

FlatTriangle UvLayout::in_uv(std::uint32_t piece) const {
  const auto [m, t] = pieces_[piece];
  const std::uint32_t* v = scene_.meshes[m].triangles[t].v;
  return {place(uv_[m][v[0]]), place(uv_[m][v[1]]), place(uv_[m][v[2]])};
}

FlatTriangle UvLayout::triangle(std::uint32_t piece, const MapFrame& frame) const {
  const auto [m, t] = pieces_[piece];
  const std::uint32_t* v = scene_.meshes[m].triangles[t].v;
  const auto texels = [&](std::uint32_t corner) -> FlatPlace {
    const FlatPlace uv = place(uv_[m][corner]);
    return {(uv.x - frame.tile.u) * frame.width, (1.0 - (uv.y - frame.tile.v)) * frame.height};
  };
  return {texels(v[0]), texels(v[1]), texels(v[2])};
}

std::vector<UvTile> UvLayout::tiles(std::size_t& outside) const {
  std::vector<bool> has(most_u * most_v);
  outside = 0;
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    const FlatTriangle triangle = in_uv(i);
    const bool is_within = triangle.low_x() >= 0.0 && triangle.high_x() <= most_u &&
                           triangle.low_y() >= 0.0 && triangle.high_y() <= most_v;
    if (!is_within) ++outside;
    const double low = std::clamp(std::floor(triangle.low_y() + uv_rounding), 0.0, double{most_v});
    const double high = std::clamp(std::ceil(triangle.high_y() - uv_rounding), 0.0, double{most_v});
    for (int v = static_cast<int>(low); v < static_cast<int>(high); ++v) {
      double left = 0.0, right = 0.0;
      if (!triangle.span(v, v + 1, left, right)) continue;
      const double first = std::clamp(std::floor(left + uv_rounding), 0.0, double{most_u});
      const double last = std::clamp(std::ceil(right - uv_rounding), 0.0, double{most_u});
      for (int u = static_cast<int>(first); u < static_cast<int>(last); ++u) {
        has[static_cast<std::size_t>(v * most_u + u)] = true;
      }
    }
  }
  std::vector<UvTile> all;
  for (int i = 0; i < most_u * most_v; ++i) {
    if (has[static_cast<std::size_t>(i)]) all.push_back({i % most_u, i / most_u});
  }
  return all;
}

std::size_t UvLayout::outside(UvTile tile) const {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    const FlatTriangle triangle = in_uv(i);
    const bool is_within =
        triangle.low_x() >= tile.u - uv_rounding && triangle.high_x() <= tile.u + 1 + uv_rounding &&
        triangle.low_y() >= tile.v - uv_rounding && triangle.high_y() <= tile.v + 1 + uv_rounding;
    count += is_within ? 0 : 1;
  }
  return count;
}

std::string UvLayout::name_of(std::uint32_t mesh) const {
  const std::string& object = scene_.meshes[mesh].object_name;
  std::size_t number = 0, count = 0;
  for (std::uint32_t i = 0; i < scene_.meshes.size(); ++i) {
    if (scene_.meshes[i].object_name != object) continue;
    ++count;
    if (i <= mesh) ++number;
  }
  const std::string name = object.empty() ? "mesh" : object;
  if (count < 2) return name;
  const std::string& material = scene_.meshes[mesh].material_name;
  return fmt::format("{} (primitive {}{}{})", name, number, material.empty() ? "" : ", ", material);
}

}  // namespace nacre::host
