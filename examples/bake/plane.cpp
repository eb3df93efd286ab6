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

void Plane::fill(std::string_view channel, int first, int rows, std::vector<float>& values) const {
  const float du = 1.0f / static_cast<float>(width_);
  const float dv = 1.0f / static_cast<float>(height_);
  const Linear line = meaning(channel, du, dv);
  values.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width_));
  std::size_t next = 0;
  for (int j = first; j < first + rows; ++j) {
    const float v = static_cast<float>(corner_v_) + (1.0f - (static_cast<float>(j) + 0.5f) * dv);
    for (int i = 0; i < width_; ++i) {
      const float u = static_cast<float>(corner_u_) + (static_cast<float>(i) + 0.5f) * du;
      values[next++] = line.constant + line.u * u + line.v * v;
    }
  }
}

}  // namespace nacre::host
