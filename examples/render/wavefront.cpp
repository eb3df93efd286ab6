#include "examples/render/wavefront.h"

#include <algorithm>
#include <chrono>

#include "examples/render/mis.h"
#include "examples/render/offset.h"

namespace nacre::host {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Stopwatch::Stopwatch(double& seconds) : seconds_(seconds), start_(now()) {}
Stopwatch::~Stopwatch() { seconds_ += now() - start_; }

Wavefront::Wavefront(const RenderContext& context, std::size_t given_paths)
    : context_(context),
      buffer_(context.settings.batch_size, context.state_bytes, context.primvars) {
  buffer_.batch.time = context.settings.time;
  buffer_.batch.frame = context.settings.frame;
  const std::size_t max_paths = given_paths << context.settings.techniques.split_events;
  for (auto* list : {&active_, &next_, &sorted_, &light_order_, &shadow_order_}) {
    list->reserve(max_paths);
  }
  rays_.resize(max_paths);
  ray_hits_.resize(max_paths);
  hits_.resize(max_paths);
  light_samples_.resize(max_paths);
  met_at_.resize(max_paths);
  met_groups_.resize(context.materials.size());
  light_points_.reserve(max_paths);
  shadows_.reserve(max_paths);
  blocked_.resize(max_paths);
  points_.reserve(context.settings.batch_size);
  groups_.resize(context.materials.size());
  light_groups_.resize(context.materials.size());
  shadow_groups_.resize(context.materials.size());
  lit_groups_.resize(context.point_lights.size());
  weighed_.resize(context.settings.batch_size);
  prepare_passes(max_paths);
  prepare_techniques(max_paths);
}

void Wavefront::trace(std::span<Path> paths) {
  paths_ = with_forks(paths);
  counts_.paths += paths.size();
  begin_passes();
  active_.clear();
  for (std::uint32_t i = 0; i < given_; ++i) active_.push_back(i);
  while (!active_.empty()) {
    next_.clear();
    shadows_.clear();
    shadow_media_.clear();
    connections_.clear();
    intersect();
    if (context_.any_media) cross_media();
    if (context_.any_volume) meet_media();
    if (!scatterings_.empty()) connect_media();
    add_environment();
    group_by_material();
    if (context_.any_nested) pass_hidden();
    if (context_.any_volume) enter_volumes();
    if (context_.any_opacity) apply_opacity();
    if (context_.any_matte) hold_out();
    if (connects()) sample_lights();
    shade();
    trace_shadows();
    active_.swap(next_);
  }
  join_forks(paths);
}

void Wavefront::intersect() {
  const std::size_t count = active_.size();
  bool straight = true;
  for (std::size_t i = 0; i < count; ++i) {
    const Path& path = paths_[active_[i]];
    rays_[i] = path.ray;
    rays_[i].kind = path.from_camera ? ray_camera : ray_secondary;
    straight = straight && path.from_camera;
  }
  counts_.rays += count;
  {
    const Stopwatch watch(counts_.tracing_seconds);
    context_.bvh.intersect({rays_.data(), count}, {ray_hits_.data(), count}, straight);
  }
  for (std::size_t i = 0; i < count; ++i) hits_[active_[i]] = ray_hits_[i];
}

void Wavefront::add_environment() {
  if (context_.environment == nullptr) return;
  missed_.clear();
  ways_out_.clear();
  for (const std::uint32_t i : active_) {
    const Path& path = paths_[i];
    if (!hits_[i].missed() || path.unlit) continue;
    missed_.push_back(i);
    ways_out_.push_back(path.ray.direction);
  }
  found_.resize(missed_.size());
  context_.environment->light(ways_out_, found_);
  for (std::size_t k = 0; k < missed_.size(); ++k) {
    const Path& path = paths_[missed_[k]];
    const float light_pdf = context_.lights.environment_chance() * found_[k].pdf;
    add_found(missed_[k], hit_weight(path, light_pdf) * (path.throughput * found_[k].radiance),
              context_.settings.passes.groups.of_environment, true);
  }
}

void Wavefront::group_by_material() {
  group_by(active_.size(), sorted_, groups_, [this](std::size_t i) {
    const Hit& hit = hits_[active_[i]];
    if (hit.missed()) return ~0u;
    const std::uint32_t exit = paths_[active_[i]].media.exit(hit.mesh, hit.instance);
    return exit != Media::no_exit ? exit : context_.material_of(surface_point(active_[i]));
  });
  for (std::uint32_t& i : sorted_) i = active_[i];
}

/// Ends the camera's paths on mattes, and takes them out of their group.
void Wavefront::hold_out() {
  for (Group& group : groups_) {
    const auto begin = sorted_.begin() + group.begin, end = sorted_.begin() + group.end;
    const auto kept = std::remove_if(begin, end, [this](std::uint32_t i) {
      Path& path = paths_[i];
      const bool held_out = path.from_camera && context_.scene.meshes[hits_[i].mesh].matte;
      if (held_out) path.alpha = 0.f;
      return held_out;
    });
    group.end = static_cast<std::uint32_t>(kept - sorted_.begin());
  }
}

SurfacePoint Wavefront::surface_point(std::uint32_t i) const {
  const Hit& hit = hits_[i];
  const Path& path = paths_[i];
  const float distance = path.distance + hit.distance;
  return {hit.mesh,
          hit.triangle,
          hit.u,
          hit.v,
          -path.ray.direction,
          path.from_camera,
          distance,
          path.width + path.spread * distance,
          hit.instance,
          path.ray.time,
          hit.normal};
}

Vec3 leave(const BatchBuffer& buffer, std::size_t lane, Vec3 direction) {
  const Vec3 p = load(buffer.batch.P, lane);
  const Vec3 ng = load(buffer.batch.Ng, lane);
  if (!(dot(ng, direction) < 0.f)) return offset_point(p, ng);
  return offset_point(p + load(buffer.through, lane), -ng);
}

void Wavefront::fill(std::span<const std::uint32_t> paths, const Material& material) {
  points_.clear();
  for (const std::uint32_t i : paths) points_.push_back(surface_point(i));
  context_.geometry.fill(points_, material.capabilities, context_.camera, buffer_);
  clamp_roughness(paths);
  draw_texels(paths, std::identity(), Draw::texel);
  if (context_.any_nested) fill_exterior(paths);
}

Uniform2 Wavefront::draw(const Path& path, Draw what) const {
  return uniform2(context_.settings.sampler, path.key, what);
}

/// One pair for each of the paths, in their order.
void Wavefront::draw(std::span<const std::uint32_t> paths, Draw what,
                     std::vector<Uniform2>& numbers) {
  keys_.clear();
  for (const std::uint32_t i : paths) keys_.push_back(paths_[i].key);
  numbers.resize(paths.size());
  uniform2(context_.settings.sampler, keys_, what, numbers);
}

bool Wavefront::connects() const {
  return context_.settings.strategy != Strategy::bsdf_only && !context_.lights.empty();
}

/// Weight of light found by the path's own direction.
float Wavefront::hit_weight(const Path& path, float light_pdf) const {
  if (path.light_blind || context_.settings.strategy == Strategy::bsdf_only) return 1.f;
  if (context_.settings.strategy == Strategy::light_only) return light_pdf > 0.f ? 0.f : 1.f;
  return power_heuristic(path.pdf, light_pdf);
}

/// Weight of light found by light sampling.
float Wavefront::connection_weight(float light_pdf, float material_pdf) const {
  if (context_.settings.strategy == Strategy::light_only) return 1.f;
  return power_heuristic(light_pdf, material_pdf);
}

}  // namespace nacre::host
