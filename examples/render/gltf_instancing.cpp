#include "examples/render/gltf_instancing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "examples/render/gltf_transform.h"

namespace nacre::host {

namespace {

bool is_near(const Bounds& box) { return is_within_reach(box.low) && is_within_reach(box.high); }

template <std::size_t n>
std::array<double, n> element(const std::vector<float>& values, std::size_t i) {
  std::array<double, n> result{};
  for (std::size_t c = 0; c < n; ++c) result[c] = static_cast<double>(values[n * i + c]);
  return result;
}

}  // namespace

/// The values of an attribute, as many elements as the others have; none where it is missing.
std::optional<std::vector<float>> GltfInstancing::read(const GltfValue& index, int components,
                                                       std::size_t& count) {
  if (!index) return std::vector<float>();
  const auto a = accessors_.attribute(index, components);
  if (!a) return {};
  if (a->components != components) {
    index.error("the accessor has another type than its attribute needs",
                fmt::format("{} components", components), fmt::format("{}", a->components));
    return {};
  }
  if (count != 0 && a->count != count) {
    index.error("an attribute has another length than the ones before",
                fmt::format("{} elements", count), fmt::format("{}", a->count));
    return {};
  }
  count = a->count;
  // A motion each, and the three lists of what they are made of.
  const std::size_t bytes = count * (sizeof(Motion) + sizeof(Affine) + 4 * 10);
  if (!budget_.take_bytes(index.location(), bytes)) return {};
  std::vector<float> values = GltfAccessors::floats(*a);
  const auto bad = std::ranges::find_if(values, [](float v) { return !std::isfinite(v); });
  if (bad == values.end()) return values;
  index.error("a value of the instances is not finite", "finite numbers",
              fmt::format("{:g}", *bad));
  return {};
}

std::optional<std::vector<Affine>> GltfInstancing::offsets(const GltfValue& attributes) {
  for (const std::string& name : attributes.names()) {
    if (name == "TRANSLATION" || name == "ROTATION" || name == "SCALE") continue;
    dropped_.say("instance-attributes-not-rendered", attributes[name.c_str()],
                 "attributes of instances other than their transform are not rendered",
                 "TRANSLATION, ROTATION or SCALE", name);
  }
  std::size_t count = 0;
  const auto translations = read(attributes["TRANSLATION"], 3, count);
  const auto rotations = translations ? read(attributes["ROTATION"], 4, count) : std::nullopt;
  const auto scales = rotations ? read(attributes["SCALE"], 3, count) : std::nullopt;
  if (!scales) return {};
  if (count == 0) {
    attributes.error("the instances have no transform", "TRANSLATION, ROTATION or SCALE", "none");
    return {};
  }
  std::vector<Affine> list;
  list.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    NodeTransform one;
    if (!translations->empty()) one.translation = element<3>(*translations, i);
    if (!rotations->empty()) one.rotation = element<4>(*rotations, i);
    if (!scales->empty()) one.scale = element<3>(*scales, i);
    const bool has_axis =
        !one.rotation || std::ranges::any_of(*one.rotation, [](double q) { return q != 0; });
    if (!has_axis) {
      attributes["ROTATION"].error("the rotation has no axis", "unit quaternions",
                                   fmt::format("zeros for instance {}", i));
      return {};
    }
    list.push_back(affine(one));
  }
  return list;
}

std::optional<std::vector<Motion>> GltfInstancing::places(const GltfValue& node,
                                                          const Motion& world) {
  const GltfValue extension = node["extensions"]["EXT_mesh_gpu_instancing"];
  std::vector<Motion> list;
  if (!extension) {
    list.push_back(world);
  } else {
    const GltfValue attributes = extension["attributes"];
    if (!attributes.need("an object of attributes")) return {};
    const auto own = offsets(attributes);
    if (!own) return {};
    const SourceLocation where = extension.location();
    for (const Affine& offset : *own) {
      const std::size_t bytes = world.is_still() ? 0 : world.steps() * sizeof(Affine);
      if (!budget_.take_bytes(where, bytes)) return {};
      list.push_back(world * Motion(offset));
    }
  }
  for (const Motion& place : list) {
    if (is_invertible(place)) continue;
    const float d = determinant(place.at(0.f));
    node.error("the transform of the node has no inverse",
               "a determinant that is neither 0 nor beyond all floats",
               place.is_still() ? fmt::format("{:g}", d) : "one that is while the shutter is open");
    return {};
  }
  return list;
}

bool GltfInstancing::place(Mesh& mesh, const std::vector<Motion>& places,
                           const GltfValue& primitive) {
  const SourceLocation where = primitive.location();
  const Bounds own = vertex_bounds(mesh);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Motion& motion = places[i];
    const std::size_t segments = std::max<std::size_t>(motion.segments().size(), 1);
    if (!budget_.take_instance(where, i == 0, segments, motion.steps())) return false;
    if (!is_near(instance_bounds(own, motion))) {
      primitive.error("an instance of the mesh is out of range",
                      fmt::format("coordinates of at most {:g}", largest_coordinate), "beyond");
      return false;
    }
  }
  mesh.instances = places;
  return true;
}

}  // namespace nacre::host
