#include <algorithm>
#include <cassert>
#include <cmath>

#include "examples/render/wavefront.h"

namespace nacre::host {

void Wavefront::prepare_techniques(std::size_t max_paths) {
  const Techniques& techniques = context_.settings.techniques;
  if (techniques.split_events == 0) return;
  forks_.resize(max_paths);
  // The parts of what both forks share are not known.
  assert(!context_.settings.passes.any(PassNeed::split));
}

/// The same paths where there is room for what may fork off them.
std::span<Path> Wavefront::with_forks(std::span<Path> paths) {
  given_ = paths.size();
  if (forks_.empty()) return paths;
  std::ranges::copy(paths, forks_.begin());
  const std::size_t all = given_ << context_.settings.techniques.split_events;
  for (std::size_t i = given_; i < all; ++i) forks_[i].radiance = {};
  return {forks_.data(), all};
}

/// Gives the paths what those have brought that forked off them.
void Wavefront::join_forks(std::span<Path> paths) {
  if (forks_.empty()) return;
  for (std::size_t i = given_; i < paths_.size(); ++i) {
    paths_[i % given_].radiance += paths_[i].radiance;
    if (splits_.empty()) continue;
    for (std::size_t g = 0; g < splits_[i].group.size(); ++g) {
      splits_[i % given_].group[g] += splits_[i].group[g];
    }
  }
  std::ranges::copy(paths_.first(given_), paths.begin());
}

bool Wavefront::may_fork(const Material& material, const Path& path) const {
  const std::int32_t lobes = material.capabilities.lobes;
  const int most = context_.settings.techniques.split_events;
  // Below a surface a path has events that its depth does not count.
  const bool is_early = path.forks < most && path.depth < most;
  return is_early && path.depth < context_.settings.max_depth && (lobes & reflecting_lobes) != 0 &&
         (lobes & transmitting_lobes) != 0;
}

/// Sends copies of the paths that fork along what the surface lets through.
void Wavefront::fork(const Material& material, std::span<const std::uint32_t> paths) {
  const auto forks = [&](std::uint32_t i) { return may_fork(material, paths_[i]); };
  if (std::ranges::none_of(paths, forks)) return;
  want_lobes(material, paths, transmitting_lobes);
  sample(material, paths);
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const std::uint32_t from = paths[lane];
    if (!forks(from)) continue;
    // What has forked k times lies below given_ << k, so that this place is nobody else's.
    const int before = paths_[from].forks;
    const auto to = from + static_cast<std::uint32_t>(given_ << before);
    paths_[to] = paths_[from];
    paths_[to].radiance = {};
    ++paths_[to].forks;                           // The other's is counted once it was sampled.
    paths_[to].key.event += 1u << (16 + before);  // Numbers of its own.
    hits_[to] = hits_[from];
    go_on(material, to, lane);
  }
}

/// How smooth facets may be in the points of a batch. What is asked of other points, the emission
/// and opacity of what light sampling meets, has none.
void Wavefront::clamp_roughness(std::span<const std::uint32_t> paths) {
  if (!context_.settings.techniques.clamps_roughness) return;
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    buffer_.batch.min_alpha[lane] = paths_[paths[lane]].min_alpha;
  }
}

/// What images give at the points of a batch, each of which a path has met or asks about.
void Wavefront::draw_texels(std::span<const std::uint32_t> points,
                            const std::function<std::uint32_t(std::uint32_t)>& path_of, Draw what,
                            std::uint32_t step) {
  if (!context_.settings.techniques.draws_texels) return;
  keys_.clear();
  for (const std::uint32_t i : points) {
    keys_.push_back(paths_[path_of(i)].key);
    keys_.back().step += step;
  }
  texel_numbers_.resize(points.size());
  uniform2(context_.settings.sampler, keys_, what, texel_numbers_);
  for (std::size_t lane = 0; lane < points.size(); ++lane) {
    buffer_.batch.texture_u[lane] = texel_numbers_[lane].x;
  }
}

/// The lobes that are sampled and evaluated next; where paths fork, of these only `of_forks`.
void Wavefront::want_lobes(const Material& material, std::span<const std::uint32_t> paths,
                           std::int32_t of_forks) {
  const Techniques& techniques = context_.settings.techniques;
  if (!techniques.chooses_lobes()) return;
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const Path& path = paths_[paths[lane]];
    std::int32_t wanted = all_lobes;
    if (!techniques.caustics && path.is_diffuse) wanted &= diffuse_lobes;
    if (may_fork(material, path)) wanted &= of_forks;
    buffer_.batch.lobes_wanted[lane] = wanted;
  }
}

/// What a path was scattered by.
void Wavefront::note_lobe(Path& path, std::size_t lane) const {
  const Techniques& techniques = context_.settings.techniques;
  if (!techniques.chooses_lobes()) return;
  path.is_diffuse = path.is_diffuse || (buffer_.sample.kinds[lane] & diffuse_lobes) != 0;
  if (techniques.clamps_roughness) {
    path.min_alpha = std::max(path.min_alpha, buffer_.sample.alpha[lane]);
  }
}

Vec3 Wavefront::limited(Vec3 contribution, bool is_indirect) const {
  const float most = context_.settings.techniques.indirect_limit;
  const float brightest = max_component(contribution);
  if (!is_indirect || !(most > 0.f) || !(brightest > most)) return contribution;
  return std::isfinite(brightest) ? (most / brightest) * contribution : contribution;
}

/// Russian roulette; `before`: what the path carried before its last event.
bool Wavefront::survives(Path& path, Vec3 before) const {
  float chance = max_component(path.throughput);
  switch (context_.settings.techniques.roulette) {
    case Roulette::none: return true;
    case Roulette::throughput: break;
    case Roulette::event: chance = std::sqrt(chance / max_component(before)); break;
  }
  chance = std::min(1.f, chance);
  if (!(draw(path, Draw::roulette).x < chance)) return false;
  path.throughput = (1.f / chance) * path.throughput;
  return true;
}

}  // namespace nacre::host
