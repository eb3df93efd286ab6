#include "examples/bake_mesh/transport.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "examples/render/offset.h"
#include "examples/render/sampler.h"

namespace nacre::host {

namespace {

/// Rays around `n`, by the cosine with it, of which those to the side of `side` are kept.
std::vector<Ray> rays_around(const TransportPoint& point, Vec3 n, Vec3 side, std::uint32_t event,
                             const TransportSettings& settings) {
  std::vector<Ray> rays;
  rays.reserve(static_cast<std::size_t>(settings.rays));
  const Vec3 origin = offset_point(point.P, side);
  const Vec3 along = perpendicular(n), across = cross(n, along);
  for (int i = 0; i < settings.rays; ++i) {
    const Uniform2 u =
        uniform2(SamplerKind::sobol,
                 {.pixel = point.seed, .sample = static_cast<std::uint32_t>(i), .event = event},
                 Draw::direction);
    const float radius = std::sqrt(u.x), angle = 2.f * std::numbers::pi_v<float> * u.y;
    const Vec3 direction = (radius * std::cos(angle)) * along +
                           (radius * std::sin(angle)) * across +
                           std::sqrt(std::max(0.f, 1.f - u.x)) * n;
    if (dot(direction, side) > 0.f)
      rays.push_back({origin, normalize(direction), settings.distance});
  }
  return rays;
}

}  // namespace

Openness openness(const Bvh& scene, const TransportPoint& point,
                  const TransportSettings& settings) {
  const std::vector<Ray> rays = rays_around(point, point.N, point.Ng, 0, settings);
  std::vector<std::uint8_t> blocked(rays.size());
  scene.occluded(rays, blocked);
  Vec3 sum;
  std::size_t open = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (blocked[i] != 0) continue;
    ++open;
    sum += rays[i].direction;
  }
  if (rays.empty()) return {1.f, point.N};
  return {static_cast<float>(open) / static_cast<float>(rays.size()), normalize_or(sum, point.N)};
}

float thickness(const Bvh& scene, const TransportPoint& point, const TransportSettings& settings) {
  const std::vector<Ray> rays = rays_around(point, -point.N, -point.Ng, 1, settings);
  std::vector<Hit> hits(rays.size());
  scene.intersect(rays, hits, false);
  double sum = 0.0;
  std::size_t count = 0;
  for (const Hit& hit : hits) {
    const float length = hit.missed() ? settings.distance : hit.distance;
    if (!std::isfinite(length)) continue;
    sum += static_cast<double>(length);
    ++count;
  }
  return count == 0 ? 0.f : static_cast<float>(sum / static_cast<double>(count));
}

}  // namespace nacre::host
