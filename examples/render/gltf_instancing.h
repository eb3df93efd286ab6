#pragma once

#include <optional>
#include <vector>

#include "examples/render/gltf_accessor.h"
#include "examples/render/gltf_dropped.h"
#include "examples/render/mesh.h"
#include "examples/render/scene_budget.h"

namespace nacre::host {

/// Where the mesh of a node is drawn: where the node is, or at each place that
/// EXT_mesh_gpu_instancing lists.
class GltfInstancing {
 public:
  GltfInstancing(GltfAccessors& accessors, SceneBudget& budget, GltfDropped& dropped)
      : accessors_(accessors), budget_(budget), dropped_(dropped) {}

  /// Nothing after an error: lists that are wrong, or a place without an inverse.
  std::optional<std::vector<Motion>> places(const GltfValue& node, const Motion& world);

  /// Makes instances of a mesh in its own space. False, with an error, where one reaches too far
  /// or they are too many.
  bool place(Mesh& mesh, const std::vector<Motion>& places, const GltfValue& primitive);

 private:
  std::optional<std::vector<float>> read(const GltfValue& index, int components,
                                         std::size_t& count);
  std::optional<std::vector<Affine>> offsets(const GltfValue& attributes);

  GltfAccessors& accessors_;
  SceneBudget& budget_;
  GltfDropped& dropped_;
};

}  // namespace nacre::host
