#include <algorithm>
#include <cmath>

#include "examples/render/wavefront.h"

namespace nacre::host {

namespace {

/// Nothing where it is no number; and no more than products of it can be numbers.
float amount(float x) { return x > 0.f ? std::min(x, 1e30f) : 0.f; }
Vec3 amount(Vec3 v) { return {amount(v.x), amount(v.y), amount(v.z)}; }

}  // namespace

Medium medium_of(const InteriorLanes& lanes, std::size_t lane) {
  const float g = lanes.anisotropy[lane];
  return {amount(load(lanes.absorption, lane)), amount(load(lanes.scattering, lane)),
          std::isfinite(g) ? std::clamp(g, -0.999f, 0.999f) : 0.f};
}

Medium medium_of(const VolumeLanes& lanes, std::size_t lane) {
  Medium medium = medium_of(lanes.medium, lane);
  medium.emission = amount(load(lanes.emission, lane));
  return medium;
}

/// Takes the paths that are inside of something to where they meet a surface, or are scattered
/// before. Those go on from there; those in what varies are in `met_` then.
void Wavefront::cross_media() {
  met_.clear();
  const auto is_over = [this](std::uint32_t i) {
    Path& path = paths_[i];
    if (path.media.empty()) return false;
    const Medium medium = path.media.current();
    const float far = hits_[i].missed() ? INFINITY : hits_[i].distance;
    if (medium.varies()) return may_meet(i, medium, far);
    if (!is_zero(medium.emission)) path.radiance += path.throughput * emitted(medium, far);
    const Flight flight = sample_flight(medium, path.throughput, far, draw(path, Draw::flight));
    path.throughput *= flight.weight;
    if (!is_finite(path.throughput)) {
      ++statistics_.invalid_results;
      return true;
    }
    if (!(max_component(path.throughput) > 0.f)) return true;
    if (flight.scatters && scatter_inside(path, medium, flight.distance)) next_.push_back(i);
    return flight.scatters;
  };
  active_.erase(std::remove_if(active_.begin(), active_.end(), is_over), active_.end());
}

/// False where the path ends.
bool Wavefront::scatter_inside(Path& path, const Medium& medium, float distance) {
  if (++path.scatterings > context_.settings.max_scatterings) {
    ++statistics_.paths_cut;
    return false;
  }
  const float brightest = max_component(path.throughput);
  if (brightest < 1.f) {
    if (!(draw(path, Draw::roulette).x < brightest)) return false;
    path.throughput = (1.f / brightest) * path.throughput;
  }
  const Scattered to = sample_phase(medium.anisotropy, path.ray.direction, draw(path, Draw::phase));
  if (path.from_camera) path.spread = context_.camera.sample_angle();
  path.width += path.spread * (path.distance + distance);
  path.spread = std::max(path.spread, scattered_spread(to.pdf));
  path.distance = 0.f;
  path.from_camera = false;
  path.vertex = path.ray.origin + distance * path.ray.direction;
  path.pdf = to.pdf;
  // Lights are not sampled from inside: what encloses the medium is in the way.
  path.light_blind = true;
  path.ray = {path.vertex, to.direction, INFINITY, ray_secondary, path.ray.time};
  ++path.key.event;
  return true;
}

/// What light is in behind the surface, where the samples of a batch go there.
void Wavefront::find_media(const Material& material, std::size_t lanes) {
  const auto any = [&](std::uint32_t flag) {
    return std::any_of(buffer_.sample.flags, buffer_.sample.flags + lanes,
                       [&](std::uint32_t flags) { return (flags & flag) != 0; });
  };
  if (material.capabilities.has_interior && any(sample_transmitted)) {
    material.shader->interior(buffer_.batch, buffer_.interior);
  }
  if (material.capabilities.has_subsurface && any(sample_subsurface)) {
    material.shader->subsurface(buffer_.batch, buffer_.sample.lobe, buffer_.below);
  }
}

/// As the sample of a lane goes through a surface: into what it encloses, or out. Through a fibre
/// light has gone already.
void Wavefront::change_medium(const Material& material, Path& path, const Hit& hit,
                              std::size_t lane) {
  if (context_.scene.meshes[hit.mesh].is_fibres()) return;
  const Vec3 wi = load(buffer_.sample.wi, lane);
  const bool is_below = (buffer_.sample.flags[lane] & sample_subsurface) != 0;
  const bool leaves = path.media.exit(hit.mesh, hit.instance) != Media::no_exit ||
                      (!is_below && !(dot(load(buffer_.batch.Ng, lane), wi) < 0.f));
  if (leaves) return path.media.leave(hit.mesh, hit.instance);
  if (!is_below && !material.capabilities.has_interior) return;
  const InteriorLanes& lanes = is_below ? buffer_.below.medium : buffer_.interior;
  const Medium medium = medium_of(lanes, lane);
  if (medium.is_empty()) return;
  if (!path.media.enter(hit.mesh, hit.instance, medium,
                        is_below ? material.exit : Media::no_exit)) {
    ++statistics_.media_dropped;
  }
}

}  // namespace nacre::host
