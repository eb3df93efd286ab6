#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "examples/render/light_bounds.h"

namespace nacre::host {

/// A binary tree over lights that are somewhere. A light is drawn by going down, at each node to
/// either child in proportion to importance(): Conty Estevez and Kulla 2018; the build and the
/// trails as in Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", 4th edition, section
/// 12.6.3. No subtree is split up, so that one light is drawn.
class LightTree {
 public:
  LightTree() = default;
  /// `lights` are known by their indices. Dark ones are never drawn. Not more than 2^31.
  explicit LightTree(const std::vector<LightBounds>& lights);

  struct Choice {
    std::uint32_t light;
    double probability;
  };

  /// Whether no light can be drawn anywhere.
  bool empty() const { return nodes_.empty(); }
  /// u in [0, 1). Nothing where no light contributes, or where it is not known before a group of
  /// lights has been taken.
  std::optional<Choice> sample(const LitPlace& at, double u) const;
  /// That sample() gives this light there, the same number.
  double probability(const LitPlace& at, std::uint32_t light) const;

 private:
  struct Node {
    LightBounds bounds;
    /// Of a leaf: its light. Else the second child; the first is the next node.
    std::uint32_t index = 0;
    bool is_leaf = false;
  };
  struct Builder;

  double first_share(std::uint32_t node, const LitPlace& at) const;

  static constexpr std::uint64_t none = ~std::uint64_t{0};
  std::vector<Node> nodes_;  ///< Depth first.
  /// By light: bit i says whether the way to it goes to the second child of its i-th node.
  std::vector<std::uint64_t> trails_;
};

}  // namespace nacre::host
