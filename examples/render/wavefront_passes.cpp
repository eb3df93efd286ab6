#include <algorithm>

#include "examples/render/wavefront.h"

namespace nacre::host {

namespace {

/// a / b by channel; 0 where there is nothing to share.
Vec3 ratio(Vec3 a, Vec3 b) {
  const auto of = [](float x, float y) { return y > 0.f ? x / y : 0.f; };
  return {of(a.x, b.x), of(a.y, b.y), of(a.z, b.z)};
}

Shares shares_of(const PartLanes& parts, std::size_t lane, Vec3 whole) {
  Shares shares;
  for (std::size_t c = 0; c < scatter_classes; ++c) {
    shares[c] = ratio(load(parts[c], lane), whole);
  }
  return shares;
}

Shares all_of(ScatterClass one) {
  Shares shares;
  shares[static_cast<std::size_t>(one)] = {1.f, 1.f, 1.f};
  return shares;
}

void add(std::array<Vec3, scatter_classes>& to, const Shares& shares, Vec3 light) {
  for (std::size_t c = 0; c < scatter_classes; ++c) to[c] += shares[c] * light;
}

}  // namespace

/// Memory for what passes need of a thread.
void Wavefront::prepare_passes(std::size_t max_paths) {
  const PassRequest& request = context_.settings.passes;
  const std::uint32_t capacity = buffer_.capacity();
  if (request.any(PassNeed::split) || request.any(PassNeed::group)) splits_.resize(max_paths);
  if (request.any(PassNeed::split)) {
    traces_.resize(max_paths);
    part_memory_.emplace(6 * scatter_classes * LaneMemory::lane_bytes(capacity));
    for (PartLanes* parts : {&sample_parts_, &value_parts_}) {
      for (Lanes3& lanes : *parts) lanes = part_memory_->lanes3(capacity);
    }
    buffer_.sample.parts = &sample_parts_;
    buffer_.value.parts = &value_parts_;
  }
  if (!request.any(PassNeed::hit)) return;
  first_hits_.resize(max_paths);
  asks_points_ = request.any(PassNeed::point);
  asks_motion_ = request.any(PassNeed::motion);
  const std::size_t values = request.value_floats();
  values_.resize(values * max_paths);
  point_memory_.emplace((7 + values) * LaneMemory::lane_bytes(capacity));
  point_ = {point_memory_->lanes3(capacity),
            point_memory_->lanes3(capacity),
            point_memory_->floats(capacity),
            {}};
  for (std::size_t k = 0; k < values; ++k) point_.values.push_back(point_memory_->floats(capacity));
}

void Wavefront::begin_passes() {
  if (!splits_.empty()) std::fill_n(splits_.begin(), paths_.size(), LightSplit{});
  if (!traces_.empty()) std::fill_n(traces_.begin(), paths_.size(), Trace{});
  if (first_hits_.empty()) return;
  std::fill_n(first_hits_.begin(), paths_.size(), FirstHit{});
  std::fill(values_.begin(), values_.end(), 0.f);
}

PathRecord Wavefront::record(std::size_t i) const {
  PathRecord record;
  if (!splits_.empty()) record.light = splits_[i];
  if (!first_hits_.empty()) record.hit = first_hits_[i];
  const std::size_t values = point_.values.size();
  record.values = std::span(values_).subspan(i * values, values);
  return record;
}

/// Light that a path has found by its own direction.
void Wavefront::add_found(std::uint32_t i, Vec3 found, std::uint8_t group, bool is_background) {
  const Vec3 light = limited(found, paths_[i].depth > 1);
  paths_[i].radiance += light;
  if (splits_.empty()) return;
  LightSplit& to = splits_[i];
  to.group[group] += light;
  if (traces_.empty()) return;
  const Trace& trace = traces_[i];
  if (trace.events == 0) {
    (is_background ? to.background : to.emission) += light;
  } else {
    add(trace.events == 1 ? to.direct : to.indirect, trace.shares, light);
  }
}

/// Light that nothing was in the way of.
void Wavefront::add_connected(const ShadowRay& shadow) {
  paths_[shadow.path].radiance += shadow.contribution;
  if (splits_.empty()) return;
  LightSplit& to = splits_[shadow.path];
  const Connection& by = connections_[shadow.connection];
  to.group[by.group] += shadow.contribution;
  add(by.is_direct ? to.direct : to.indirect, by.shares, shadow.contribution);
}

/// Of the shadow ray that was added last, which goes from a lane of the batch.
void Wavefront::note_connection(std::uint32_t path, std::size_t lane) {
  if (splits_.empty()) return;
  if (traces_.empty()) return connect_as({{}, light_samples_[path].group, false});
  const Trace& trace = traces_[path];
  connect_as({trace.is_known ? trace.shares
                             : shares_of(value_parts_, lane, load(buffer_.value.value, lane)),
              light_samples_[path].group, trace.events == 0});
}

/// The same from within a medium, where the path has been scattered just now.
void Wavefront::note_connection_inside(std::uint32_t path) {
  if (splits_.empty()) return;
  if (traces_.empty()) return connect_as({{}, light_samples_[path].group, false});
  const Trace& trace = traces_[path];
  connect_as({trace.shares, light_samples_[path].group, trace.events == 1});
}

void Wavefront::connect_as(const Connection& connection) {
  shadows_.back().connection = static_cast<std::uint32_t>(connections_.size());
  connections_.push_back(connection);
}

/// That a surface scatters a path as the sample of a lane says.
void Wavefront::note_scattering(std::uint32_t path, std::size_t lane) {
  if (traces_.empty()) return;
  Trace& trace = traces_[path];
  const bool is_below = (buffer_.sample.flags[lane] & sample_subsurface) != 0;
  if (!trace.is_known) {
    trace.is_known = true;
    trace.shares = is_below ? all_of(ScatterClass::subsurface)
                            : shares_of(sample_parts_, lane, load(buffer_.sample.weight, lane));
  }
  // What goes below and comes back is scattered once: where it leaves.
  trace.is_below = is_below;
  if (!is_below) ++trace.events;
}

/// That a medium does.
void Wavefront::note_scattering_inside(std::uint32_t path) {
  if (traces_.empty() || traces_[path].is_below) return;
  Trace& trace = traces_[path];
  if (!trace.is_known) trace.shares = all_of(ScatterClass::volume);
  trace.is_known = true;
  ++trace.events;
}

/// Which of those of a batch see it first, and what.
void Wavefront::record_hits(const Material& material, std::span<const std::uint32_t> paths) {
  const auto is_first = [this](std::uint32_t i) { return paths_[i].from_camera; };
  if (first_hits_.empty() || std::ranges::none_of(paths, is_first)) return;
  const std::size_t lanes = LaneMemory::lane_bytes(buffer_.capacity()) / sizeof(float);
  const Lanes3 blank = point_.albedo;
  for (float* x : {blank.x, blank.y, blank.z, point_.roughness}) std::fill_n(x, lanes, 0.f);
  for (float* x : point_.values) std::fill_n(x, lanes, 0.f);
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    const Vec3 n = load(buffer_.batch.N, lane);
    store(point_.normal, lane, dot(n, load(buffer_.batch.wo, lane)) < 0.f ? -n : n);
  }
  if (asks_points_) {
    const Stopwatch watch(counts_.shading_seconds);
    material.shader->point(buffer_.batch, buffer_.state, point_);
  }
  for (std::size_t lane = 0; lane < paths.size(); ++lane) {
    if (is_first(paths[lane])) record_hit(paths[lane], lane);
  }
}

void Wavefront::record_hit(std::uint32_t i, std::size_t lane) {
  const SurfacePoint point = surface_point(i);
  FirstHit& hit = first_hits_[i];
  hit.is_there = true;
  hit.albedo = load(point_.albedo, lane);
  hit.normal = load(point_.normal, lane);
  hit.roughness = point_.roughness[lane];
  hit.position = load(buffer_.batch.P, lane);
  hit.depth = context_.camera.depth(hit.position, point.time);
  hit.uv = {buffer_.batch.uv.x[lane], buffer_.batch.uv.y[lane]};
  hit.mesh = point.mesh;
  if (asks_motion_) hit.motion = motion_of(point);
  for (std::size_t k = 0; k < point_.values.size(); ++k) {
    values_[i * point_.values.size() + k] = point_.values[k][lane];
  }
}

/// How far its image moves from where the shutter opens to where it closes.
Vec2 Wavefront::motion_of(SurfacePoint point) const {
  const auto place = [&](float time) {
    point.time = time;
    return context_.camera.place(surface_position(context_.scene, point), time);
  };
  const Vec2 before = place(0.f), after = place(1.f);
  return {after.x - before.x, after.y - before.y};
}

}  // namespace nacre::host
