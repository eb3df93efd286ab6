#include "examples/render/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "examples/render/scene_limits.h"

namespace nacre::host {

namespace {

/// The square to the unit disk with equal areas: Shirley and Chiu 1997, "A Low
/// Distortion Map Between Disk and Square", JGT 2(3).
Vec2 to_disk(Uniform2 u) {
  const float a = 2.f * u.x - 1.f, b = 2.f * u.y - 1.f;
  if (a == 0.f && b == 0.f) return {};
  constexpr float quarter = std::numbers::pi_v<float> / 4.f;
  const bool wide = std::abs(a) > std::abs(b);
  const float r = wide ? a : b;
  const float phi = wide ? quarter * (b / a) : 2.f * quarter - quarter * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

}  // namespace

bool check_camera(const Camera& camera, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  const auto check = [&](const char* what, bool ok, std::string expected, std::string found) {
    if (ok) return;
    diagnostics.error("bad-camera", {}, fmt::format("the camera's {} cannot be used", what),
                      std::move(expected), std::move(found));
  };
  const auto show = [](Vec3 v) { return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z); };
  const auto is_unit = [](Vec3 v) { return std::abs(dot(v, v) - 1.f) < 1e-3f; };
  const std::string within = fmt::format("at most {:g}", largest_coordinate);
  check("position", is_within_reach(camera.position), "coordinates of " + within,
        show(camera.position));
  for (const Vec3& axis : {camera.forward, camera.right, camera.up}) {
    check("direction", is_unit(axis), "unit vectors", show(axis));
  }
  const float fov = camera.vertical_fov, lens = camera.lens_radius, focus = camera.focus_distance;
  check("field of view", fov >= smallest_fov && fov <= largest_fov,
        fmt::format("{:g} to {:g} radians", smallest_fov, largest_fov), fmt::format("{:g}", fov));
  check("lens radius", lens >= 0.f && lens <= largest_coordinate, "0, or " + within,
        fmt::format("{:g}", lens));
  check("focus distance", !(lens > 0.f) || (focus > 0.f && focus <= largest_coordinate),
        "more than 0, " + within, fmt::format("{:g}", focus));
  return diagnostics.error_count() == errors;
}

Camera look_at(Vec3 position, Vec3 target, float vertical_fov) {
  Camera camera;
  camera.position = position;
  camera.forward = normalize_or(target - position, {0.f, 0.f, -1.f});
  camera.right = normalize_or(cross(camera.forward, {0.f, 1.f, 0.f}), {1.f, 0.f, 0.f});
  camera.up = cross(camera.right, camera.forward);
  camera.vertical_fov = vertical_fov;
  camera.focus_distance = length(target - position);
  return camera;
}

namespace {

/// False where the frame has no forward.
bool turn(const Affine& world, Camera& camera) {
  const Vec3 none = {};
  camera.position = world.origin;
  camera.forward = normalize_or(-world.z, none);
  if (!(dot(camera.forward, camera.forward) > 0.f)) return false;
  camera.right = normalize_or(cross(camera.forward, normalize_or(world.y, none)),
                              perpendicular(camera.forward));
  camera.up = cross(camera.right, camera.forward);
  return true;
}

Affine frame(const Camera& camera) {
  return {camera.right, camera.up, -camera.forward, camera.position};
}

}  // namespace

bool place_camera(const Motion& world, Camera& camera, Motion& motion) {
  if (!turn(world.at(0.f), camera)) return false;
  motion = {};
  if (world.is_still()) return true;
  const Affine back = inverse(frame(camera));
  std::vector<Motion::Segment> segments = world.segments();
  for (Motion::Segment& segment : segments) {
    for (Affine& step : segment.steps) {
      Camera there = camera;
      if (!turn(step, there)) return false;
      step = frame(there) * back;
    }
  }
  motion = Motion(std::move(segments));
  return true;
}

Camera fit_camera(const Bounds& box, float aspect) {
  constexpr float fov = 0.6f;
  const Vec3 centre = box.empty() ? Vec3{} : 0.5f * (box.low + box.high);
  const float radius = box.empty() ? 1.f : 0.5f * length(box.high - box.low);
  const float half = std::atan(std::tan(0.5f * fov) * std::min(aspect, 1.f));
  const float distance = std::max(radius, 1e-20f) / std::sin(half);
  return look_at(centre + distance * normalize({0.55f, 0.35f, 1.f}), centre, fov);
}

PixelCamera::PixelCamera(const Camera& camera, int width, int height, float sample_spacing,
                         const Motion& motion)
    : camera_(camera), motion_(motion), spacing_(sample_spacing) {
  const float distance = camera.lens_radius > 0.f ? camera.focus_distance : 1.f;
  const float pixel =
      2.f * distance * std::tan(0.5f * camera.vertical_fov) / static_cast<float>(height);
  step_x_ = pixel * camera.right;
  step_y_ = -pixel * camera.up;
  corner_ = distance * camera.forward - 0.5f * static_cast<float>(width) * step_x_ -
            0.5f * static_cast<float>(height) * step_y_;
  angle_ = spacing_ * pixel / distance;
}

bool PixelCamera::may_see(Vec3 centre, float radius) const {
  const Vec3 way = centre - camera_.position;
  const float distance = length(way);
  if (has_lens() || !motion_.is_still() || !(distance > radius)) return true;
  const float to_corner = std::acos(std::min(dot(normalize(corner_), camera_.forward), 1.f));
  const float to_centre = std::acos(std::clamp(dot(way, camera_.forward) / distance, -1.f, 1.f));
  // Filters see a few samples more.
  return to_centre <= to_corner + std::asin(radius / distance) + 8.f * angle_;
}

PixelCamera::Ray PixelCamera::ray(float x, float y, Uniform2 lens, float time) const {
  if (motion_.is_still()) return standing_ray(x, y, lens);
  const Ray ray = standing_ray(x, y, lens);
  const Affine moved = motion_.at(time);
  return {transform_point(moved, ray.origin), normalize(transform_vector(moved, ray.direction))};
}

void PixelCamera::footprint(Vec3 direction, float distance, Vec3 n, float time, Vec3& dPdx,
                            Vec3& dPdy) const {
  if (motion_.is_still()) return standing_footprint(direction, distance, n, dPdx, dPdy);
  const Affine moved = motion_.at(time), back = inverse(moved);
  standing_footprint(normalize(transform_vector(back, direction)), distance,
                     normalize(transform_normal(moved, n)), dPdx, dPdy);
  dPdx = transform_vector(moved, dPdx);
  dPdy = transform_vector(moved, dPdy);
}

Vec3 PixelCamera::from_camera(Vec3 P, float time) const {
  return (motion_.is_still() ? P : transform_point(inverse(motion_.at(time)), P)) -
         camera_.position;
}

float PixelCamera::depth(Vec3 P, float time) const {
  return dot(from_camera(P, time), camera_.forward);
}

Vec2 PixelCamera::place(Vec3 P, float time) const {
  const Vec3 way = from_camera(P, time);
  // To the plane in focus, where the pixels are.
  const Vec3 focus = (dot(corner_, camera_.forward) / dot(way, camera_.forward)) * way - corner_;
  return {dot(focus, step_x_) / dot(step_x_, step_x_), dot(focus, step_y_) / dot(step_y_, step_y_)};
}

PixelCamera::Ray PixelCamera::standing_ray(float x, float y, Uniform2 lens) const {
  const Vec3 focus = corner_ + x * step_x_ + y * step_y_;
  if (!(camera_.lens_radius > 0.f)) return {camera_.position, normalize(focus)};
  const Vec2 disk = camera_.lens_radius * to_disk(lens);
  const Vec3 shift = disk.x * camera_.right + disk.y * camera_.up;
  return {camera_.position + shift, normalize(focus - shift)};
}

void PixelCamera::standing_footprint(Vec3 direction, float distance, Vec3 n, Vec3& dPdx,
                                     Vec3& dPdy) const {
  // D(x) = focus(x) - lens is not normalised and linear in x; P = O + s D.
  const float focal = camera_.lens_radius > 0.f ? camera_.focus_distance : 1.f;
  const float along = dot(direction, camera_.forward);
  const float s = spacing_ * distance * along / focal;
  const float cosine = dot(direction, n);
  // A grazing footprint is as long as we like; a bound keeps it finite.
  const float safe = std::copysign(std::max(std::abs(cosine), 1e-4f), cosine);
  dPdx = s * (step_x_ - (dot(step_x_, n) / safe) * direction);
  dPdy = s * (step_y_ - (dot(step_y_, n) / safe) * direction);
}

}  // namespace nacre::host
