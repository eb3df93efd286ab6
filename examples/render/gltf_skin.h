#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "examples/render/gltf_accessor.h"
#include "examples/render/motion.h"
#include "examples/render/scene_budget.h"

namespace nacre::host {

/// A skin (glTF 2.0, 3.7.3): where its joints are, and which of them each vertex follows.
class GltfSkin {
 public:
  /// Where a node is in the world; null where the scene has it not.
  using World = std::function<const Motion*(std::size_t node)>;

  /// Nothing after an error: a joint that is not in the scene, or matrices that are too few. The
  /// motions live as long.
  static std::optional<GltfSkin> read(const GltfValue& root, const GltfValue& skin,
                                      GltfAccessors& accessors, SceneBudget& budget,
                                      const World& world);

  /// What takes a vertex from where it is stored to the world, for each joint, at a time of the
  /// shutter.
  std::vector<Affine> matrices(float time) const;
  bool is_still() const;
  /// Steps that the joints' motion has, of all segments.
  std::size_t steps() const;
  std::size_t size() const { return joints_.size(); }

 private:
  std::vector<const Motion*> joints_;
  std::vector<Affine> inverse_bind_;  ///< As many; empty: identities.
};

/// JOINTS_n and WEIGHTS_n of a primitive, all sets: `count` joints for each vertex.
struct SkinWeights {
  std::size_t count = 0;
  std::vector<std::uint16_t> joints;
  std::vector<float> weights;  ///< Of each vertex with sum 1.

  /// The sum that linear blend skinning makes of the joints' matrices.
  Affine blend(const std::vector<Affine>& matrices, std::size_t vertex) const;
};

/// Nothing after an error. Vertices whose weights are all 0 follow the first joint.
std::optional<SkinWeights> read_skin_weights(const GltfValue& attributes, std::size_t vertices,
                                             std::size_t joints, GltfAccessors& accessors,
                                             SceneBudget& budget);

}  // namespace nacre::host
