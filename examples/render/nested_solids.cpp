#include "examples/render/nested_solids.h"

#include <algorithm>
#include <cstddef>

#include "examples/render/mesh.h"

namespace nacre::host {

namespace {

/// The box of an object, wherever it moves.
struct Box {
  Bounds bounds;
  std::uint32_t mesh;
};

std::vector<Box> boxes_of(const Scene& scene) {
  std::vector<Box> boxes;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const Bounds own = vertex_bounds(mesh);
    if (own.empty()) continue;
    if (mesh.instances.empty()) boxes.push_back({own, m});
    for (const Motion& instance : mesh.instances) {
      boxes.push_back({instance_bounds(own, instance), m});
    }
  }
  return boxes;
}

/// Calls f(a, b) on the meshes of boxes that overlap, until it says that that is enough.
template <class F>
void for_overlaps(const std::vector<Box>& sorted, F f) {
  const auto overlap = [](float low_a, float high_a, float low_b, float high_b) {
    return low_a < high_b && low_b < high_a;
  };
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const Bounds& a = sorted[i].bounds;
    for (std::size_t k = i + 1; k < sorted.size(); ++k) {
      const Bounds& b = sorted[k].bounds;
      if (!(b.low.x < a.high.x)) break;
      if (!overlap(a.low.y, a.high.y, b.low.y, b.high.y)) continue;
      if (!overlap(a.low.z, a.high.z, b.low.z, b.high.z)) continue;
      if (!f(sorted[i].mesh, sorted[k].mesh)) return;
    }
  }
}

}  // namespace

NestedSolids find_nested_solids(const Scene& scene,
                                const std::function<bool(std::uint32_t mesh)>& lets_in) {
  std::vector<Box> boxes = boxes_of(scene);
  std::ranges::sort(boxes, {}, [](const Box& box) { return box.bounds.low.x; });
  enum class Known : std::uint8_t { nothing, no, yes };
  std::vector<Known> known(scene.meshes.size(), Known::nothing);
  const auto is_solid = [&](std::uint32_t mesh) {
    if (known[mesh] == Known::nothing) {
      const bool yes = lets_in(mesh) && is_closed(scene.meshes[mesh]);
      known[mesh] = yes ? Known::yes : Known::no;
    }
    return known[mesh] == Known::yes;
  };
  bool any = false;
  for_overlaps(boxes, [&](std::uint32_t a, std::uint32_t b) {
    any = is_solid(a) && is_solid(b);
    return !any;
  });
  if (!any) return {};
  NestedSolids found;
  found.within.resize(scene.meshes.size(), false);
  for_overlaps(boxes, [&](std::uint32_t a, std::uint32_t b) {
    if (is_solid(a)) found.within[b] = true;
    if (is_solid(b)) found.within[a] = true;
    return true;
  });
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    found.solid.push_back(known[m] == Known::yes);  // What is alone need not be asked.
  }
  return found;
}

}  // namespace nacre::host
