#pragma once

#include <optional>
#include <vector>

#include "examples/render/gltf_accessor.h"
#include "examples/render/gltf_animation.h"
#include "examples/render/gltf_skin.h"
#include "examples/render/mesh.h"

namespace nacre::host {

/// What bends the vertices of a primitive: morph targets (glTF 2.0, 3.7.2.2), then a skin.
class GltfDeform {
 public:
  GltfDeform(GltfAccessors& accessors, const GltfAnimation& animation, SceneBudget& budget)
      : accessors_(accessors), animation_(animation), budget_(budget) {}

  /// Bends a mesh as it was read from the primitive, before it is finished: it gets a pose for
  /// each step of time, where it moves while the shutter is open. `skin`: null for none; with one
  /// the vertices are in the world afterwards. False after an error.
  bool apply(const GltfValue& node, std::size_t node_number, const GltfValue& source,
             const GltfValue& primitive, const GltfSkin* skin, Mesh& mesh);

 private:
  struct Target {
    std::vector<float> position, normal, tangent;  ///< 3 a vertex; empty: none.
  };

  bool read_targets(const GltfValue& list, std::size_t vertices, std::vector<Target>& targets);
  std::optional<std::vector<float>> offsets(const GltfValue& index, std::size_t vertices);

  GltfAccessors& accessors_;
  const GltfAnimation& animation_;
  SceneBudget& budget_;
};

}  // namespace nacre::host
