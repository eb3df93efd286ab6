#include "examples/render/area_light.h"

#include <algorithm>
#include <cassert>

#include "examples/render/batch_buffer.h"

namespace nacre::host {

Capabilities ConstantEmitter::capabilities() const {
  Capabilities c;
  c.emits = true;
  c.scatters = false;
  return c;
}

void ConstantEmitter::emission(const ShadingBatch& batch, Lanes3 radiance) const {
  for (std::size_t i = 0; i < batch.count; ++i) {
    const bool front = dot(load(batch.Ng, i), load(batch.wo, i)) > 0.f;
    store(radiance, i, front || two_sided_ ? radiance_ : Vec3{});
  }
}

void AreaLights::add(const Scene& scene, std::uint32_t mesh, const std::vector<float>& luminance) {
  const Mesh& m = scene.meshes[mesh];
  assert(luminance.size() == m.triangles.size());
  if (first_of_mesh_.size() <= mesh) first_of_mesh_.resize(mesh + 1, ~0u);
  first_of_mesh_[mesh] = static_cast<std::uint32_t>(entries_.size());
  for (std::uint32_t i = 0; i < m.triangles.size(); ++i) {
    const Triangle& t = m.triangles[i];
    const Vec3 a = m.position[t.v[0]];
    const float area = 0.5f * length(cross(m.position[t.v[1]] - a, m.position[t.v[2]] - a));
    const bool usable = std::isfinite(luminance[i]) && luminance[i] > 0.f;
    entries_.push_back({mesh, i, area, usable ? area * luminance[i] : 0.f});
  }
}

void AreaLights::finish() {
  total_ = 0;
  for (const Entry& e : entries_) total_ += e.weight;
  cdf_.assign(1, 0.f);
  double running = 0;
  for (const Entry& e : entries_) {
    running += e.weight;
    cdf_.push_back(total_ > 0 ? static_cast<float>(running / total_) : 0.f);
  }
}

AreaLights::Sample AreaLights::sample(float choice, Uniform2 position) const {
  assert(!empty());
  const auto above = std::upper_bound(cdf_.begin(), cdf_.end(), choice);
  const auto last = static_cast<std::ptrdiff_t>(entries_.size()) - 1;
  const auto i =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - cdf_.begin() - 1, 0, last));
  const Entry& e = entries_[i];
  // Even over the triangle: Heitz 2019, "A Low-Distortion Map Between Triangle
  // and Square".
  float u = position.x, v = position.y;
  if (v > u) {
    u *= 0.5f;
    v -= u;
  } else {
    v *= 0.5f;
    u -= v;
  }
  return {e.mesh, e.triangle, u, v, area_pdf(e.mesh, e.triangle)};
}

float AreaLights::area_pdf(std::uint32_t mesh, std::uint32_t triangle) const {
  if (mesh >= first_of_mesh_.size() || first_of_mesh_[mesh] == ~0u || empty()) return 0.f;
  const std::size_t i = first_of_mesh_[mesh] + triangle;
  return (cdf_[i + 1] - cdf_[i]) / entries_[i].area;
}

}  // namespace nacre::host
