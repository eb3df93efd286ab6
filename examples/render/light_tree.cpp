#include "examples/render/light_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <span>

namespace nacre::host {

namespace {

float component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

float middle(const LightBounds& light, int axis) {
  return 0.5f * component(light.box.low, axis) + 0.5f * component(light.box.high, axis);
}

constexpr int bucket_count = 12;

/// Which part of [low, low + extent] it is in.
int bucket_of(float at, float low, float extent) {
  const float share = static_cast<float>(bucket_count) * ((at - low) / extent);
  return std::clamp(static_cast<int>(share), 0, bucket_count - 1);
}

/// What it costs to have these together: intensity, directions and size (section 4.4 of the paper).
/// Of lights on a line the surface of the box is 0, so its squared diagonal counts as well.
double cost_of(const LightBounds& bounds) {
  const Vec3 size = bounds.box.high - bounds.box.low;
  const double x = double{size.x}, y = double{size.y}, z = double{size.z};
  const double area = 2 * (x * y + y * z + z * x) + x * x + y * y + z * z;
  return bounds.intensity * orientation_measure(bounds) * area;
}

struct Split {
  int axis = -1;  ///< -1: none.
  int first = 0;  ///< Buckets before the cut.
  double cost = std::numeric_limits<double>::infinity();
};

/// The surface area orientation heuristic. Thin boxes are better than long ones: an axis counts
/// more the shorter it is against the longest.
void try_axis(std::span<const std::uint32_t> order, const std::vector<LightBounds>& lights,
              const Bounds& middles, int axis, double longest, Split& best) {
  const float low = component(middles.low, axis);
  const float extent = component(middles.high, axis) - low;
  if (!(extent > 0.f) || !std::isfinite(extent)) return;
  std::array<LightBounds, bucket_count> buckets;
  for (const std::uint32_t i : order) {
    LightBounds& bucket =
        buckets[static_cast<std::size_t>(bucket_of(middle(lights[i], axis), low, extent))];
    bucket = united(bucket, lights[i]);
  }
  std::array<double, bucket_count> behind{};  // Cost of that bucket and all after it.
  LightBounds all;
  for (std::size_t b = bucket_count; b-- > 1;) {
    if (buckets[b].is_dark()) {
      behind[b] = b + 1 < bucket_count ? behind[b + 1] : -1.0;  // None.
      continue;
    }
    all = united(all, buckets[b]);
    behind[b] = cost_of(all);
  }
  LightBounds before;
  for (std::size_t b = 1; b < bucket_count; ++b) {
    if (buckets[b - 1].is_dark() || behind[b] < 0.0) continue;  // No cut, or the one before it.
    before = united(before, buckets[b - 1]);
    const double cost = longest / double{extent} * (cost_of(before) + behind[b]);
    if (cost < best.cost) best = {axis, static_cast<int>(b), cost};
  }
}

}  // namespace

struct LightTree::Builder {
  const std::vector<LightBounds>& lights;
  std::vector<Node>& nodes;
  std::vector<std::uint64_t>& trails;

  /// Deeper than this lights are halved by number, so that a trail has bits enough.
  static constexpr int deepest_split = 32;

  void build(std::span<std::uint32_t> order, std::uint64_t trail, int depth) {
    const std::size_t own = nodes.size();
    nodes.emplace_back();
    if (order.size() == 1) {
      nodes[own] = {lights[order[0]], order[0], true};
      trails[order[0]] = trail;
      return;
    }
    const std::size_t cut = split(order, depth);
    build(order.first(cut), trail, depth + 1);
    const auto second = static_cast<std::uint32_t>(nodes.size());
    build(order.subspan(cut), trail | std::uint64_t{1} << depth, depth + 1);
    nodes[own] = {united(nodes[own + 1].bounds, nodes[second].bounds), second, false};
  }

  /// Brings those of the first child to the front, and says how many they are.
  std::size_t split(std::span<std::uint32_t> order, int depth) const {
    Bounds middles;
    for (const std::uint32_t i : order) {
      middles.add({middle(lights[i], 0), middle(lights[i], 1), middle(lights[i], 2)});
    }
    const double longest = double{max_component(middles.high - middles.low)};
    Split best;
    for (int axis = 0; axis < 3 && depth < deepest_split; ++axis) {
      try_axis(order, lights, middles, axis, longest, best);
    }
    if (best.axis < 0) return order.size() / 2;
    const float low = component(middles.low, best.axis);
    const float extent = component(middles.high, best.axis) - low;
    const auto second = std::partition(order.begin(), order.end(), [&](std::uint32_t i) {
      return bucket_of(middle(lights[i], best.axis), low, extent) < best.first;
    });
    return static_cast<std::size_t>(second - order.begin());
  }
};

LightTree::LightTree(const std::vector<LightBounds>& lights) : trails_(lights.size(), none) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (!lights[i].is_dark()) order.push_back(i);
  }
  if (order.empty()) return;
  nodes_.reserve(2 * order.size() - 1);
  Builder{lights, nodes_, trails_}.build(order, 0, 0);
}

/// The chance that the way goes on from a node to its first child; -1: no child has any. A child
/// that has some can be drawn, however much more the other has.
double LightTree::first_share(std::uint32_t node, const LitPlace& at) const {
  constexpr double least = 0x1p-40;
  const double first = importance(nodes_[node + 1].bounds, at);
  const double second = importance(nodes_[nodes_[node].index].bounds, at);
  if (!(second > 0.0)) return first > 0.0 ? 1.0 : -1.0;
  return first > 0.0 ? std::clamp(first / (first + second), least, 1.0 - least) : 0.0;
}

std::optional<LightTree::Choice> LightTree::sample(const LitPlace& at, double u) const {
  if (empty() || !(importance(nodes_[0].bounds, at) > 0.0)) return {};
  std::uint32_t node = 0;
  double probability = 1.0;
  while (!nodes_[node].is_leaf) {
    const double first = first_share(node, at);
    if (first < 0.0) return {};
    const bool goes_first = u < first;
    const double share = goes_first ? first : 1.0 - first;
    u = std::min((goes_first ? u : u - first) / share, 0x1.fffffffffffffp-1);
    probability *= share;
    node = goes_first ? node + 1 : nodes_[node].index;
  }
  return Choice{nodes_[node].index, probability};
}

double LightTree::probability(const LitPlace& at, std::uint32_t light) const {
  assert(light < trails_.size());
  std::uint64_t trail = trails_[light];
  if (trail == none || !(importance(nodes_[0].bounds, at) > 0.0)) return 0.0;
  std::uint32_t node = 0;
  double probability = 1.0;
  for (; !nodes_[node].is_leaf; trail >>= 1) {
    const double first = first_share(node, at);
    if (first < 0.0) return 0.0;
    const bool goes_first = (trail & 1) == 0;
    probability *= goes_first ? first : 1.0 - first;
    node = goes_first ? node + 1 : nodes_[node].index;
  }
  return probability;
}

}  // namespace nacre::host
