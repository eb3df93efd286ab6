#include "examples/render/exit_shader.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "examples/render/batch_buffer.h"

namespace nacre::host {

namespace {

constexpr std::size_t state_arrays = 14;

/// The arrays of the state; the normals come first.
float* state_array(void* state, std::uint32_t count, std::size_t number) {
  return static_cast<float*>(state) + number * (LaneMemory::lane_bytes(count) / sizeof(float));
}
Lanes3 state_lanes(void* state, std::uint32_t count, std::size_t first) {
  return {state_array(state, count, first), state_array(state, count, first + 1),
          state_array(state, count, first + 2)};
}

/// The normal of the surface itself, on the side that light leaves to.
Vec3 outside(const ShadingBatch& batch, std::size_t lane) {
  const Vec3 ng = load(batch.Ng, lane);
  return dot(ng, load(batch.wo, lane)) < 0.f ? ng : -ng;
}

/// Density of light that leaves about `normal`; nothing goes back through the surface.
float density(Vec3 normal, Vec3 outside, Vec3 wi) {
  if (!(dot(outside, wi) > 0.f)) return 0.f;
  return std::max(0.f, dot(normal, wi)) * std::numbers::inv_pi_v<float>;
}

}  // namespace

Capabilities ExitShader::capabilities() const {
  const Capabilities of_surface = surface_.capabilities();
  Capabilities c;
  c.attributes = of_surface.attributes;
  c.matrix_entries = of_surface.matrix_entries;
  c.primvars = of_surface.primvars;
  return c;
}

std::size_t ExitShader::state_bytes(std::uint32_t capacity) const {
  return state_arrays * LaneMemory::lane_bytes(capacity);
}

void ExitShader::begin(const ShadingBatch& batch, void* state) const {
  const std::uint32_t n = batch.count;
  const Lanes3 normals = state_lanes(state, n, 0);
  auto* lobes = reinterpret_cast<std::int32_t*>(state_array(state, n, 13));
  std::fill_n(lobes, n, 0);
  surface_.subsurface(
      batch, lobes,
      {{state_lanes(state, n, 3), state_lanes(state, n, 6), state_array(state, n, 12)},
       state_lanes(state, n, 9),
       normals});
  for (std::size_t lane = 0; lane < n; ++lane) {
    const Vec3 out = outside(batch, lane);
    const Vec3 normal = normalize_or(load(normals, lane), out);
    store(normals, lane, dot(normal, out) < 0.f ? -normal : normal);
  }
}

void ExitShader::sample(const ShadingBatch& batch, const void* state, Lanes3 u,
                        SampleLanes out) const {
  const Lanes3 normals = state_lanes(const_cast<void*>(state), batch.count, 0);
  for (std::size_t lane = 0; lane < batch.count; ++lane) {
    const Vec3 n = load(normals, lane), x = perpendicular(n);
    const float sine = std::sqrt(u.y[lane]), phi = 2.f * std::numbers::pi_v<float> * u.z[lane];
    const Vec3 wi = sine * std::cos(phi) * x + sine * std::sin(phi) * cross(n, x) +
                    std::sqrt(1.f - u.y[lane]) * n;
    const float pdf = density(n, outside(batch, lane), wi);
    store(out.wi, lane, wi);
    store(out.weight, lane, {1.f, 1.f, 1.f});
    out.pdf[lane] = pdf;
    out.flags[lane] = pdf > 0.f ? sample_valid | sample_transmitted : 0u;
    out.lobe[lane] = 0;
    if (out.kinds != nullptr) out.kinds[lane] = diffuse_transmission;
    if (out.alpha != nullptr) out.alpha[lane] = 0.f;
  }
}

void ExitShader::evaluate(const ShadingBatch& batch, const void* state, Lanes3 wi,
                          EvaluateLanes out) const {
  const Lanes3 normals = state_lanes(const_cast<void*>(state), batch.count, 0);
  for (std::size_t lane = 0; lane < batch.count; ++lane) {
    const float pdf = density(load(normals, lane), outside(batch, lane), load(wi, lane));
    store(out.value, lane, {pdf, pdf, pdf});
    out.pdf[lane] = pdf;
  }
}

}  // namespace nacre::host
