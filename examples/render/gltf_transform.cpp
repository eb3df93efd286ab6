#include "examples/render/gltf_transform.h"

#include <algorithm>

namespace nacre::host {

namespace {

Vec3 vec3(const double* v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

template <std::size_t n>
std::optional<std::array<double, n>> numbers(const GltfValue& value) {
  const auto list = value.numbers(n);
  if (!list) return {};
  std::array<double, n> result{};
  std::ranges::copy(*list, result.begin());
  return result;
}

}  // namespace

NodeTransform node_transform(const GltfValue& node) {
  NodeTransform result;
  if (const auto columns = node["matrix"].numbers(16)) {
    const double* c = columns->data();
    result.matrix = {vec3(c), vec3(c + 4), vec3(c + 8), vec3(c + 12)};
    return result;
  }
  result.rotation = numbers<4>(node["rotation"]);
  result.scale = numbers<3>(node["scale"]);
  result.translation = numbers<3>(node["translation"]);
  const bool has_axis =
      !result.rotation || std::ranges::any_of(*result.rotation, [](double q) { return q * q > 0; });
  if (!has_axis) {
    node["rotation"].error("the rotation has no axis", "a unit quaternion", "zeros");
  }
  return result;
}

Affine affine(const NodeTransform& transform) {
  if (transform.matrix) return *transform.matrix;
  Affine a;
  if (const auto& q = transform.rotation) {
    const double x = (*q)[0], y = (*q)[1], z = (*q)[2], w = (*q)[3];
    const double n = x * x + y * y + z * z + w * w;
    const double s = n > 0 ? 2 / n : 0;
    const double r[9] = {1 - s * (y * y + z * z), s * (x * y + z * w),     s * (x * z - y * w),
                         s * (x * y - z * w),     1 - s * (x * x + z * z), s * (y * z + x * w),
                         s * (x * z + y * w),     s * (y * z - x * w),     1 - s * (x * x + y * y)};
    a.x = vec3(r), a.y = vec3(r + 3), a.z = vec3(r + 6);
  }
  if (const auto& s = transform.scale) {
    const Vec3 scale = vec3(s->data());
    a.x = scale.x * a.x, a.y = scale.y * a.y, a.z = scale.z * a.z;
  }
  if (const auto& t = transform.translation) a.origin = vec3(t->data());
  return a;
}

}  // namespace nacre::host
