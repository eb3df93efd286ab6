#include "examples/image_input/plane.h"

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>

namespace graph_image {

namespace {

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

nacre::Layout column(PlaneArray array) { return {array, 0, sizeof(float), sizeof(float)}; }

/// The same number for all points.
nacre::Layout single(int index) {
  return {array_change,
          static_cast<std::ptrdiff_t>(index) * static_cast<std::ptrdiff_t>(sizeof(float)), 0,
          sizeof(float)};
}

}  // namespace

void bind_plane(const nacre::Shader& shader, nacre::Binder& binder) {
  for (const nacre::Channel& channel : shader.inputs(NACRE_OUTPUTS)) {
    const std::string_view name = channel.name;
    const bool is_uv = name.starts_with("uv");
    const bool is_uv_change = name.starts_with("duv");
    if ((is_uv && name.ends_with(".x")) || is_one_of(name, {"P.x", "Po.x"})) {
      binder.array(channel.name, column(array_u));
    } else if ((is_uv && name.ends_with(".y")) || is_one_of(name, {"P.y", "Po.y"})) {
      binder.array(channel.name, column(array_v));
    } else if ((is_uv_change && name.ends_with("dx.x")) || is_one_of(name, {"dPdx.x", "dPodx.x"})) {
      binder.array(channel.name, single(0));
    } else if ((is_uv_change && name.ends_with("dy.y")) || is_one_of(name, {"dPdy.y", "dPody.y"})) {
      binder.array(channel.name, single(1));
    } else {
      const bool is_one =
          is_one_of(name, {"N.z", "No.z", "Ng.z", "T.x", "To.x", "B.y", "Bo.y", "wo.z"});
      binder.constant(channel.name, {is_one ? 1.0f : 0.0f});
    }
  }
}

PlaneGrid::PlaneGrid(int width, int height, int corner_u, int corner_v)
    : corner_u_(corner_u),
      corner_v_(corner_v),
      change_{1.0f / static_cast<float>(width), -1.0f / static_cast<float>(height)} {}

}  // namespace graph_image
