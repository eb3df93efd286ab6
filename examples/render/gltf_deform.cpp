#include "examples/render/gltf_deform.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace nacre::host {

namespace {

/// Between these, vertices run straight.
constexpr std::size_t most_steps = 16;

Vec3 at(const std::vector<float>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

/// One skin's share of the vertices' new places.
void bend(MeshPose& pose, const SkinWeights& weights, const std::vector<Affine>& matrices) {
  for (std::size_t i = 0; i < pose.position.size(); ++i) {
    const Affine map = weights.blend(matrices, i);
    pose.position[i] = transform_point(map, pose.position[i]);
    if (!pose.normal.empty()) {
      const Vec3 n = transform_normal(inverse(map), pose.normal[i]);
      pose.normal[i] = is_finite(n) ? n : pose.normal[i];
    }
    if (!pose.tangent.empty()) {
      Tangent& t = pose.tangent[i];
      t.direction = transform_vector(map, t.direction);
      if (determinant(map) < 0.f) t.sign = -t.sign;
    }
  }
}

}  // namespace

std::optional<std::vector<float>> GltfDeform::offsets(const GltfValue& index,
                                                      std::size_t vertices) {
  if (!index) return std::vector<float>();
  const auto a = accessors_.attribute(index, 3);
  if (!a) return {};
  if (a->components != 3 || a->count != vertices) {
    index.error("a morph target has another form than its attribute",
                fmt::format("{} elements of 3 components", vertices),
                fmt::format("{} of {}", a->count, a->components));
    return {};
  }
  if (!budget_.take_bytes(index.location(), 12 * vertices)) return {};
  std::vector<float> values = GltfAccessors::floats(*a);
  if (std::ranges::all_of(values, [](float v) { return std::isfinite(v); })) return values;
  index.error("an offset of the morph target is not finite", "finite numbers", "one that is not");
  return {};
}

bool GltfDeform::read_targets(const GltfValue& list, std::size_t vertices,
                              std::vector<Target>& targets) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto position = offsets(list[i]["POSITION"], vertices);
    auto normal = position ? offsets(list[i]["NORMAL"], vertices) : std::nullopt;
    auto tangent = normal ? offsets(list[i]["TANGENT"], vertices) : std::nullopt;
    if (!tangent) return false;
    targets.push_back({std::move(*position), std::move(*normal), std::move(*tangent)});
  }
  return true;
}

bool GltfDeform::apply(const GltfValue& node, std::size_t node_number, const GltfValue& source,
                       const GltfValue& primitive, const GltfSkin* skin, Mesh& mesh) {
  const std::size_t vertices = mesh.position.size();
  std::vector<Target> targets;
  if (!read_targets(primitive["targets"], vertices, targets)) return false;
  if (targets.empty() && skin == nullptr) return true;
  const GltfValue stored = node["weights"].size() != 0 ? node["weights"] : source["weights"];
  std::vector<double> weights(targets.size(), 0.0);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = stored[i].number().value_or(0.0);
  }
  std::optional<SkinWeights> follows;
  if (skin != nullptr) {
    follows =
        read_skin_weights(primitive["attributes"], vertices, skin->size(), accessors_, budget_);
    if (!follows) return false;
    if (follows->count == 0) {
      primitive["attributes"].error("the mesh of a node with a skin has no joints",
                                    "JOINTS_0 and WEIGHTS_0", "none");
      return false;
    }
  }
  std::size_t steps = animation_.weight_steps(node_number);
  if (skin != nullptr && !skin->is_still())
    steps = std::max({steps, skin->steps(), std::size_t{1}});
  steps = steps == 0 ? 0 : std::min(std::bit_ceil(steps), most_steps);
  if (!budget_.take_bytes(primitive.location(), steps * vertices * sizeof(float) * 10))
    return false;

  const MeshPose rest{mesh.position, mesh.normal, mesh.tangent};
  const auto pose_at = [&](float time) {
    MeshPose pose = rest;
    const std::vector<double> shares = animation_.weights(node_number, weights, time);
    for (std::size_t k = 0; k < targets.size(); ++k) {
      const auto share = static_cast<float>(shares[k]);
      if (share == 0.f) continue;
      for (std::size_t i = 0; i < vertices; ++i) {
        if (!targets[k].position.empty()) pose.position[i] += share * at(targets[k].position, i);
        if (!targets[k].normal.empty() && !pose.normal.empty()) {
          pose.normal[i] += share * at(targets[k].normal, i);
        }
        if (!targets[k].tangent.empty() && !pose.tangent.empty()) {
          pose.tangent[i].direction += share * at(targets[k].tangent, i);
        }
      }
    }
    if (skin != nullptr) bend(pose, *follows, skin->matrices(time));
    return pose;
  };
  MeshPose first = pose_at(0.f);
  if (skin != nullptr) mesh.position_object = mesh.position;
  mesh.position = std::move(first.position);
  mesh.normal = std::move(first.normal);
  mesh.tangent = std::move(first.tangent);
  for (std::size_t k = 1; k <= steps; ++k) {
    mesh.poses.push_back(pose_at(static_cast<float>(k) / static_cast<float>(steps)));
  }
  return true;
}

}  // namespace nacre::host
