#include "examples/render/gltf_skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nacre::host {

namespace {

Affine affine(const float* column) {
  const auto vec3 = [](const float* v) { return Vec3{v[0], v[1], v[2]}; };
  return {vec3(column), vec3(column + 4), vec3(column + 8), vec3(column + 12)};
}

}  // namespace

std::optional<GltfSkin> GltfSkin::read(const GltfValue& root, const GltfValue& skin,
                                       GltfAccessors& accessors, SceneBudget& budget,
                                       const World& world) {
  GltfSkin result;
  const GltfValue joints = skin["joints"], nodes = root["nodes"];
  if (!joints.need("an array of nodes")) return {};
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto node = joints[i].index_of(nodes);
    if (!node) return {};
    result.joints_.push_back(world(*node));
    if (result.joints_.back() != nullptr) continue;
    joints[i].error("a joint is not in the scene", "a node of the scene", joints[i].shown());
    return {};
  }
  if (result.joints_.empty()) {
    joints.error("the skin has no joint", "one or more", "none");
    return {};
  }
  const GltfValue bind = skin["inverseBindMatrices"];
  if (!bind) return result;
  const auto accessor = accessors.matrices(bind);
  if (!accessor) return {};
  if (accessor->count < result.joints_.size()) {
    bind.error("the skin has too few matrices", fmt::format("{}", result.joints_.size()),
               fmt::format("{}", accessor->count));
    return {};
  }
  if (!budget.take_bytes(bind.location(),
                         accessor->count * (sizeof(Affine) + 16 * sizeof(float)))) {
    return {};
  }
  const std::vector<float> values = GltfAccessors::floats(*accessor);
  if (!std::ranges::all_of(values, [](float v) { return std::isfinite(v); })) {
    bind.error("a matrix of the skin is not finite", "finite numbers", "one that is not");
    return {};
  }
  for (std::size_t i = 0; i < result.joints_.size(); ++i) {
    result.inverse_bind_.push_back(affine(&values[16 * i]));
  }
  return result;
}

std::vector<Affine> GltfSkin::matrices(float time) const {
  std::vector<Affine> list;
  list.reserve(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Affine joint = joints_[i]->at(time);
    list.push_back(inverse_bind_.empty() ? joint : joint * inverse_bind_[i]);
  }
  return list;
}

bool GltfSkin::is_still() const {
  return std::ranges::all_of(joints_, [](const Motion* each) { return each->is_still(); });
}

std::size_t GltfSkin::steps() const {
  std::size_t most = 1;
  for (const Motion* each : joints_) most = std::max(most, each->steps());
  return most;
}

Affine SkinWeights::blend(const std::vector<Affine>& matrices, std::size_t vertex) const {
  Affine sum{{}, {}, {}, {}};
  for (std::size_t k = vertex * count; k < (vertex + 1) * count; ++k) {
    const float w = weights[k];
    if (w == 0.f) continue;
    const Affine& m = matrices[joints[k]];
    sum.x += w * m.x, sum.y += w * m.y, sum.z += w * m.z, sum.origin += w * m.origin;
  }
  return sum;
}

std::optional<SkinWeights> read_skin_weights(const GltfValue& attributes, std::size_t vertices,
                                             std::size_t joints, GltfAccessors& accessors,
                                             SceneBudget& budget) {
  std::vector<std::vector<std::uint32_t>> numbers;
  std::vector<std::vector<float>> shares;
  for (int set = 0;; ++set) {
    const GltfValue of = attributes[fmt::format("JOINTS_{}", set).c_str()];
    const GltfValue by = attributes[fmt::format("WEIGHTS_{}", set).c_str()];
    if (!of && !by) break;
    const auto joint = accessors.joints(of.need("JOINTS as many as WEIGHTS"));
    const auto weight = accessors.attribute(by.need("WEIGHTS as many as JOINTS"), 4);
    if (!joint || !weight) return {};
    for (const auto& [accessor, value] : {std::pair{&*joint, &of}, std::pair{&*weight, &by}}) {
      if (accessor->count == vertices) continue;
      value->error("an attribute has another length than POSITION",
                   fmt::format("{} elements", vertices), fmt::format("{}", accessor->count));
      return {};
    }
    if (!budget.take_bytes(of.location(), vertices * 4 * 16)) return {};
    numbers.push_back(accessors.integers(*joint));
    shares.push_back(GltfAccessors::floats(*weight));
    const auto beyond =
        std::ranges::find_if(numbers.back(), [&](std::uint32_t j) { return j >= joints; });
    if (beyond != numbers.back().end()) {
      of.error("a joint is not in the skin", fmt::format("less than {}", joints),
               fmt::format("{}", *beyond));
      return {};
    }
  }
  SkinWeights result;
  result.count = 4 * numbers.size();
  result.joints.resize(vertices * result.count);
  result.weights.resize(vertices * result.count);
  for (std::size_t v = 0; v < vertices; ++v) {
    float sum = 0.f;
    for (std::size_t k = 0; k < result.count; ++k) {
      const float w = shares[k / 4][4 * v + k % 4];
      const std::size_t place = v * result.count + k;
      result.joints[place] = static_cast<std::uint16_t>(numbers[k / 4][4 * v + k % 4]);
      result.weights[place] = std::isfinite(w) ? std::max(w, 0.f) : 0.f;
      sum += result.weights[place];
    }
    for (std::size_t k = 0; k < result.count; ++k) {
      float& w = result.weights[v * result.count + k];
      w = sum > 0.f ? w / sum : (k == 0 ? 1.f : 0.f);
    }
  }
  return result;
}

}  // namespace nacre::host
