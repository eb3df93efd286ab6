#include "examples/bake/plane.h"

#include <array>

namespace nacre::host {

namespace {

/// What a channel holds: a + b u + c v.
struct Linear {
  float constant = 0.0f;
  float u = 0.0f;
  float v = 0.0f;
};

Linear meaning(std::string_view channel, float du, float dv) {
  const auto is = [&](std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) {
      if (channel == name) return true;
    }
    return false;
  };
  if (channel.starts_with("uv")) {
    return channel.ends_with(".x") ? Linear{.u = 1.0f} : Linear{.v = 1.0f};
  }
  if (is({"P.x", "Po.x"})) return {.u = 1.0f};
  if (is({"P.y", "Po.y"})) return {.v = 1.0f};
  if (is({"N.z", "No.z", "Ng.z", "T.x", "To.x", "B.y", "Bo.y", "wo.z"})) return {.constant = 1.0f};
  // One texel to the right; one texel down, so -1 in v.
  if (is({"dPdx.x", "dPodx.x"})) return {.constant = du};
  if (is({"dPdy.y", "dPody.y"})) return {.constant = -dv};
  if (channel.starts_with("duv")) {
    if (channel.ends_with("dx.x")) return {.constant = du};
    if (channel.ends_with("dy.y")) return {.constant = -dv};
  }
  return {};
}

}  // namespace

void Plane::fill(std::string_view channel, const TexelPoints& points,
                 std::vector<float>& values) const {
  const float du = area_.width / static_cast<float>(width_);
  const float dv = area_.height / static_cast<float>(height_);
  const Linear line = meaning(channel, du * points.footprint, dv * points.footprint);
  const std::size_t count = points.x.size();
  if (line.u == 0.0f && line.v == 0.0f) {
    values.assign(count, line.constant);
    return;
  }
  values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float u = area_.u + points.x[i] * du;
    const float v = area_.v + (area_.height - points.y[i] * dv);
    values[i] = line.constant + line.u * u + line.v * v;
  }
}

bool Plane::is_constant(std::string_view channel) const {
  const Linear line = meaning(channel, 1.0f, 1.0f);
  return line.u == 0.0f && line.v == 0.0f;
}

UvArea area_of(const BakeSettings& settings) {
  if (settings.window) return *settings.window;
  return {.u = static_cast<float>(settings.corner_u), .v = static_cast<float>(settings.corner_v)};
}

}  // namespace nacre::host
