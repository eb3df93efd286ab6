#include "examples/bake_mesh/curvature.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace nacre::host {

namespace {

double dot_exactly(Vec3 a, Vec3 b) {
  return static_cast<double>(a.x) * static_cast<double>(b.x) +
         static_cast<double>(a.y) * static_cast<double>(b.y) +
         static_cast<double>(a.z) * static_cast<double>(b.z);
}

/// Of each vertex the first at its place that has its normal.
std::vector<std::uint32_t> joined(const std::vector<Vec3>& position,
                                  const std::vector<Vec3>& normal) {
  std::map<std::array<float, 6>, std::uint32_t> known;
  std::vector<std::uint32_t> first(position.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    const Vec3 p = position[i], n = normal[i];
    const std::array<float, 6> key{p.x + 0.f, p.y + 0.f, p.z + 0.f,
                                   n.x + 0.f, n.y + 0.f, n.z + 0.f};  // -0 is 0.
    first[i] = known.try_emplace(key, i).first->second;
  }
  return first;
}

}  // namespace

std::vector<float> mean_curvature(const Mesh& mesh, const Affine& to_world) {
  if (mesh.normal.empty()) return std::vector<float>(mesh.position.size());  // Flat faces.
  const Affine to_object = inverse(to_world);
  std::vector<Vec3> position = mesh.position, normal = mesh.normal;
  for (Vec3& p : position) p = transform_point(to_world, p);
  for (Vec3& n : normal) n = normalize_or(transform_normal(to_object, n), n);
  std::vector<double> sum(position.size()), weight(position.size());
  const std::vector<std::uint32_t> vertex = joined(mesh.position, mesh.normal);
  for (const Triangle& t : mesh.triangles) {
    const Vec3 e1 = position[t.v[1]] - position[t.v[0]], e2 = position[t.v[2]] - position[t.v[0]];
    const Vec3 n1 = normal[t.v[1]] - normal[t.v[0]], n2 = normal[t.v[2]] - normal[t.v[0]];
    const double uu = dot_exactly(e1, e1), uv = dot_exactly(e1, e2), vv = dot_exactly(e2, e2);
    const double squared = uu * vv - uv * uv;  // |e1 x e2|^2
    const double trace =
        (dot_exactly(n1, e1) * vv - (dot_exactly(n1, e2) + dot_exactly(n2, e1)) * uv +
         dot_exactly(n2, e2) * uu) /
        squared;
    const double area = std::sqrt(squared);
    if (!std::isfinite(trace) || !std::isfinite(area)) continue;  // Too thin to have one.
    for (const std::uint32_t v : t.v) {
      sum[vertex[v]] += area * 0.5 * trace;
      weight[vertex[v]] += area;
    }
  }
  std::vector<float> curvature(position.size());
  for (std::size_t i = 0; i < curvature.size(); ++i) {
    const std::uint32_t v = vertex[i];
    if (weight[v] > 0.0) curvature[i] = static_cast<float>(sum[v] / weight[v]);
  }
  return curvature;
}

}  // namespace nacre::host
