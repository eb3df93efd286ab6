#include <algorithm>
#include <cmath>

#include "examples/render/wavefront.h"

namespace nacre::host {

/// Takes the paths that are inside of something to where they meet a surface, or are scattered
/// before. Those go on from there; those in what varies are in `met_` then.
void Wavefront::cross_media() {
  met_.clear();
  scatterings_.clear();
  const auto is_over = [this](std::uint32_t i) {
    Path& path = paths_[i];
    if (path.media.empty()) return false;
    const Medium medium = path.media.current();
    const float far = hits_[i].missed() ? INFINITY : hits_[i].distance;
    if (medium.varies()) return may_meet(i, medium, far);
    if (!is_zero(medium.emission)) {
      add_found(i, path.throughput * emitted(medium, far),
                context_.settings.passes.groups.mesh(path.media.mesh()));
    }
    const Flight flight = sample_flight(medium, path.throughput, far, draw(path, Draw::flight));
    path.throughput *= flight.weight;
    if (!is_finite(path.throughput)) {
      ++counts_.invalid_results;
      return true;
    }
    if (!(max_component(path.throughput) > 0.f)) return true;
    if (flight.scatters && scatter_inside(i, medium, flight.distance)) next_.push_back(i);
    return flight.scatters;
  };
  active_.erase(std::remove_if(active_.begin(), active_.end(), is_over), active_.end());
}

/// False where the path ends.
bool Wavefront::scatter_inside(std::uint32_t i, const Medium& medium, float distance) {
  Path& path = paths_[i];
  if (++path.scatterings > context_.settings.max_scatterings) {
    ++counts_.paths_cut;
    return false;
  }
  const float brightest = max_component(path.throughput);
  if (brightest < 1.f) {
    if (!(draw(path, Draw::roulette).x < brightest)) return false;
    path.throughput = (1.f / brightest) * path.throughput;
  }
  note_scattering_inside(i);
  const Scattered to = sample_phase(medium.anisotropy, path.ray.direction, draw(path, Draw::phase));
  if (path.from_camera) path.spread = context_.camera.sample_angle();
  path.width += path.spread * (path.distance + distance);
  path.spread = std::max(path.spread, scattered_spread(to.pdf));
  path.distance = 0.f;
  path.from_camera = false;
  path.vertex = path.ray.origin + distance * path.ray.direction;
  path.normal = {};
  path.pdf = to.pdf;
  // From inside of what has a surface lights are not sampled: that is in the way.
  path.light_blind = !connects() || !path.media.is_open();
  if (!path.light_blind) {
    choose_light(
        i,
        {path.media.mesh(), path.media.instance(), path.ray.time, path.vertex, -path.ray.direction},
        {}, {draw(path, Draw::light_choice), draw(path, Draw::light)});
    scatterings_.push_back({i, path.ray.direction, medium.anisotropy, path.throughput});
  }
  path.ray = {path.vertex, to.direction, INFINITY, ray_secondary, path.ray.time};
  ++path.key.event;
  return true;
}

/// The light that reaches what was scattered within volumes.
void Wavefront::connect_media() {
  ask_lights();
  for (const Scattering& at : scatterings_) {
    const LightSample& light = light_samples_[at.path];
    if (!(light.pdf > 0.f)) continue;
    const float value = phase(at.anisotropy, at.along, light.wi);
    const float weight = light.unseen ? 1.f : connection_weight(light.pdf, value);
    const Vec3 contribution = limited(
        (weight * value / light.pdf) * (at.throughput * light.radiance), paths_[at.path].depth > 1);
    if (is_zero(contribution)) continue;
    if (!is_finite(contribution)) {
      ++counts_.invalid_results;
      continue;
    }
    add_shadow(light, at.path, paths_[at.path].vertex, contribution);
    note_connection_inside(at.path);
    --shadow_media_.back().key.event;  // The path has gone on already.
  }
}

/// What light is in behind the surface, where the samples of a batch go there.
void Wavefront::find_media(const Material& material, std::size_t lanes) {
  const auto any = [&](std::uint32_t flag) {
    return std::any_of(buffer_.sample.flags, buffer_.sample.flags + lanes,
                       [&](std::uint32_t flags) { return (flags & flag) != 0; });
  };
  if (material.capabilities.has_interior && any(sample_transmitted)) {
    ask_interior(material);
  }
  if (material.capabilities.has_subsurface && any(sample_subsurface)) {
    material.shader->subsurface(buffer_.batch, buffer_.sample.lobe, buffer_.below);
  }
}

/// Whether light along wi is on the inner side of a surface that encloses something.
bool Wavefront::goes_within(const Material& material, const Hit& hit, std::size_t lane,
                            Vec3 wi) const {
  return material.capabilities.has_interior && !context_.scene.meshes[hit.mesh].is_fibres() &&
         dot(load(buffer_.batch.Ng, lane), wi) < 0.f;
}

/// Whether light along wi leaves what the mesh of a hit encloses.
bool Wavefront::goes_out(const Media& media, const Hit& hit, std::size_t lane, Vec3 wi) const {
  return media.exit(hit.mesh, hit.instance) != Media::no_exit ||
         !(dot(load(buffer_.batch.Ng, lane), wi) < 0.f);
}

/// As the sample of a lane goes through a surface: into what it encloses, or out. Through a fibre
/// light has gone already.
void Wavefront::change_medium(const Material& material, Path& path, const Hit& hit,
                              std::size_t lane) {
  if (context_.scene.meshes[hit.mesh].is_fibres()) return;
  const Vec3 wi = load(buffer_.sample.wi, lane);
  const bool is_below = (buffer_.sample.flags[lane] & sample_subsurface) != 0;
  if (!is_below && goes_out(path.media, hit, lane, wi)) {
    return path.media.leave(hit.mesh, hit.instance);
  }
  if (!is_below && !material.capabilities.has_interior) return;
  if (!is_below && context_.is_solid(hit.mesh)) return enter_solid(path.media, hit, lane);
  const InteriorLanes& lanes = is_below ? buffer_.below.medium : buffer_.interior;
  const Medium medium = medium_of(lanes, lane);
  if (medium.is_empty()) return;
  if (!path.media.enter(hit.mesh, hit.instance, medium,
                        is_below ? material.exit : Media::no_exit)) {
    ++counts_.media_dropped;
  }
}

}  // namespace nacre::host
