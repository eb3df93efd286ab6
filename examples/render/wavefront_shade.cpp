#include <algorithm>

#include "examples/render/wavefront.h"

namespace nacre::host {

float scattered_spread(float pdf) {
  return std::min(0.25f, 0.25f / std::sqrt(std::max(pdf, 1e-8f)));
}

void Wavefront::shade() {
  for (std::size_t m = 0; m < groups_.size(); ++m) {
    const Group g = groups_[m];
    for_batches(std::span<const std::uint32_t>(sorted_.data() + g.begin, g.end - g.begin),
                buffer_.capacity(), [&](std::span<const std::uint32_t> paths) {
                  shade_batch(context_.materials[m], paths);
                });
  }
}

void Wavefront::shade_batch(const Material& material, std::span<const std::uint32_t> paths) {
  const bool any_goes_on = std::any_of(paths.begin(), paths.end(), [this](std::uint32_t i) {
    return paths_[i].depth < context_.settings.max_depth;
  });
  const bool scatters = material.capabilities.scatters && any_goes_on;
  if (!scatters && !material.capabilities.emits && first_hits_.empty()) return;
  fill(paths, material);
  if (material.capabilities.emits) add_emission(material, paths);
  if (scatters || asks_points_) {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->begin(buffer_.batch, buffer_.state);
  }
  record_hits(material, paths);
  if (!scatters) return;
  if (connects() && !material.capabilities.only_delta) connect_lights(material, paths);
  extend(material, paths);
}

void Wavefront::add_emission(const Material& material, std::span<const std::uint32_t> paths) {
  {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->emission(buffer_.batch, buffer_.rgb);
  }
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const Path& path = paths_[paths[lane]];
    const Vec3 emitted = load(buffer_.rgb, lane);
    if (is_zero(emitted) || path.unlit) continue;
    if (!is_finite(emitted)) {
      ++counts_.invalid_results;
      continue;
    }
    const Hit& hit = hits_[paths[lane]];
    const Vec3 way = load(buffer_.batch.P, lane) - path.vertex;
    const float cosine = std::abs(dot(load(buffer_.batch.Ng, lane), path.ray.direction));
    const bool back = dot(load(buffer_.batch.Ng, lane), path.ray.direction) > 0.f;
    const float area_pdf =
        path.light_blind
            ? 0.f
            : context_.lights.area_pdf({path.vertex, path.normal}, hit.mesh, hit.triangle, back);
    const float light_pdf = area_pdf * dot(way, way) / cosine;
    add_found(paths[lane], hit_weight(path, light_pdf) * (path.throughput * emitted),
              context_.settings.passes.groups.mesh(hit.mesh));
  }
}

void Wavefront::connect_lights(const Material& material, std::span<const std::uint32_t> paths) {
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const LightSample& light = light_samples_[paths[lane]];
    store(buffer_.wi, lane, light.pdf > 0.f ? light.wi : load(buffer_.batch.N, lane));
  }
  weigh_connections(material, paths);
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const LightSample& light = light_samples_[paths[lane]];
    if (!(light.pdf > 0.f) || goes_within(material, hits_[paths[lane]], lane, light.wi)) continue;
    const Path& path = paths_[paths[lane]];
    const Vec3 contribution = limited(
        (1.f / light.pdf) * (path.throughput * weighed_[lane] * light.radiance), path.depth > 0);
    if (is_zero(contribution)) continue;
    if (!is_finite(contribution)) {
      ++counts_.invalid_results;
      continue;
    }
    add_shadow(light, paths[lane], leave(buffer_, lane, light.wi), contribution);
    note_connection(paths[lane], lane);
    const Hit& hit = hits_[paths[lane]];
    if (context_.any_volume && goes_out(path.media, hit, lane, light.wi)) {
      shadow_media_.back().media.leave(hit.mesh, hit.instance);
    }
  }
}

/// What the lanes' light samples bring by these lobes, less what paths find of it themselves.
void Wavefront::weigh_connections(const Material& material, std::span<const std::uint32_t> paths) {
  const auto evaluate = [&] {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->evaluate(buffer_.batch, buffer_.state, buffer_.wi, buffer_.value);
  };
  const auto weighed = [&](std::size_t lane) {
    const LightSample& light = light_samples_[paths[lane]];
    const float weight = light.unseen ? 1.f : connection_weight(light.pdf, buffer_.value.pdf[lane]);
    return weight * load(buffer_.value.value, lane);
  };
  // What forks, finds light of each side by a density of its own.
  const auto forks = [&](std::size_t lane) { return may_fork(material, paths_[paths[lane]]); };
  want_lobes(material, paths, reflecting_lobes);
  evaluate();
  bool any_forks = false;
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    weighed_[lane] = weighed(lane);
    any_forks = any_forks || forks(lane);
  }
  if (!any_forks) return;
  want_lobes(material, paths, transmitting_lobes);
  evaluate();
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    if (forks(lane)) weighed_[lane] += weighed(lane);
  }
}

void Wavefront::extend(const Material& material, std::span<const std::uint32_t> paths) {
  draw(paths, Draw::lobe, numbers_);
  draw(paths, Draw::direction, more_numbers_);
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    store(buffer_.u, lane, {numbers_[lane].x, more_numbers_[lane].x, more_numbers_[lane].y});
  }
  fork(material, paths);
  want_lobes(material, paths, reflecting_lobes);
  sample(material, paths);
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    Path& path = paths_[paths[lane]];
    if (may_fork(material, path)) ++path.forks;
    go_on(material, paths[lane], lane);
  }
}

void Wavefront::sample(const Material& material, std::span<const std::uint32_t> paths) {
  const Stopwatch watch(counts_.shading_seconds);
  material.shader->sample(buffer_.batch, buffer_.state, buffer_.u, buffer_.sample);
  find_media(material, paths.size());
}

/// As the sample of a lane says.
void Wavefront::go_on(const Material& material, std::uint32_t index, std::size_t lane) {
  Path& path = paths_[index];
  if (path.depth >= context_.settings.max_depth) return;
  const Hit& hit = hits_[index];
  path.unlit = !context_.scene.meshes[hit.mesh].illuminated;
  // See sample_lights() and connect_lights().
  const bool unconnected = !path.media.is_open(hit.mesh, hit.instance) ||
                           goes_within(material, hit, lane, load(buffer_.sample.wi, lane));
  if (!scatter(path, lane, hit.distance)) return;
  note_scattering(index, lane);
  if (context_.lights.asks_where()) path.normal = lit_normal(index);
  path.light_blind = path.light_blind || unconnected;
  if ((buffer_.sample.flags[lane] & sample_transmitted) != 0) {
    change_medium(material, path, hit, lane);
  }
  next_.push_back(index);
}

/// Gives a path its next ray. False when it ends here.
bool Wavefront::scatter(Path& path, std::size_t lane, float distance) {
  const std::uint32_t flags = buffer_.sample.flags[lane];
  if ((flags & sample_valid) == 0) return false;
  const Vec3 wi = load(buffer_.sample.wi, lane);
  const Vec3 weight = load(buffer_.sample.weight, lane);
  const float pdf = buffer_.sample.pdf[lane];
  const float squared = dot(wi, wi);
  if (!is_finite(weight) || !std::isfinite(pdf) || !(squared > 0.9f && squared < 1.1f)) {
    ++counts_.invalid_results;
    return false;
  }
  const Vec3 before = path.throughput;
  path.throughput *= weight;
  if (is_zero(path.throughput)) return false;
  // What goes below and comes back is scattered once: where it leaves.
  if ((flags & sample_subsurface) == 0) ++path.depth;
  if (path.depth >= context_.settings.roulette_depth && !survives(path, before)) return false;
  note_lobe(path, lane);
  const bool delta = (flags & sample_delta) != 0;
  if (path.from_camera) path.spread = context_.camera.sample_angle();
  path.width += path.spread * (path.distance + distance);
  path.distance = 0.f;
  path.from_camera = false;
  if (!delta) path.spread = std::max(path.spread, scattered_spread(pdf));
  path.vertex = load(buffer_.batch.P, lane);
  path.pdf = pdf;
  path.light_blind = delta;
  path.ray.origin = leave(buffer_, lane, wi);
  path.ray.direction = wi;
  path.ray.far = INFINITY;
  path.ray.kind = ray_secondary;
  ++path.key.event;
  return true;
}

}  // namespace nacre::host
