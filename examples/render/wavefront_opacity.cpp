#include "examples/render/wavefront.h"

namespace nacre::host {

/// Lets paths through surfaces by chance, and takes those out of their group.
void Wavefront::apply_opacity() {
  for (std::size_t m = 0; m < groups_.size(); ++m) {
    const Material& material = context_.materials[m];
    Group& group = groups_[m];
    if (!material.capabilities.has_opacity || group.begin == group.end) continue;
    const std::span<std::uint32_t> all(sorted_.data() + group.begin, group.end - group.begin);
    std::uint32_t kept = group.begin;
    for_batches(all, buffer_.capacity(), [&](std::span<std::uint32_t> paths) {
      const std::uint32_t stay = pass_through(material, paths);
      std::copy_n(paths.begin(), stay, sorted_.begin() + kept);
      kept += stay;
    });
    group.end = kept;
  }
}

/// Moves the paths that stay to the front of `paths`; returns how many.
std::uint32_t Wavefront::pass_through(const Material& material, std::span<std::uint32_t> paths) {
  fill(paths, material);
  {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->opacity(buffer_.batch, buffer_.rgb);
  }
  std::uint32_t stay = 0;
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const std::uint32_t i = paths[lane];
    Path& path = paths_[i];
    const Vec3 opacity = clamp_unit(load(buffer_.rgb, lane));
    const Vec3 clear = Vec3{1.f, 1.f, 1.f} - opacity;
    const float chance = (clear.x + clear.y + clear.z) / 3.f;
    if (!(draw(path, Draw::opacity).x < chance)) {
      path.throughput *= (1.f / (1.f - chance)) * opacity;
      paths[stay++] = i;
      continue;
    }
    if (++path.passes > context_.settings.max_transparent) continue;
    path.throughput *= (1.f / chance) * clear;
    path.ray.origin = leave(buffer_, lane, path.ray.direction);
    path.distance += hits_[i].distance;
    ++path.key.event;
    next_.push_back(i);
  }
  return stay;
}

}  // namespace nacre::host
