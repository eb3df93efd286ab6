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
  const float du = 1.0f / static_cast<float>(width_);
  const float dv = 1.0f / static_cast<float>(height_);
  const Linear line = meaning(channel, du * points.footprint, dv * points.footprint);
  const std::size_t count = points.x.size();
  if (line.u == 0.0f && line.v == 0.0f) {
    values.assign(count, line.constant);
    return;
  }
  values.resize(count);
  const auto corner_u = static_cast<float>(corner_u_);
  const auto corner_v = static_cast<float>(corner_v_);
  for (std::size_t i = 0; i < count; ++i) {
    const float u = corner_u + points.x[i] * du;
    const float v = corner_v + (1.0f - points.y[i] * dv);
    values[i] = line.constant + line.u * u + line.v * v;
  }
}

bool Plane::is_constant(std::string_view channel) const {
  const Linear line = meaning(channel, 1.0f, 1.0f);
  return line.u == 0.0f && line.v == 0.0f;
}

}  // namespace nacre::host
