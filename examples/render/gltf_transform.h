#pragma once

#include <array>
#include <optional>

#include "examples/render/gltf_value.h"
#include "examples/render/vec.h"

namespace nacre::host {

/// What a node's transform is made of: T·R·S (glTF 2.0, 3.5.3), or a matrix.
struct NodeTransform {
  std::optional<Affine> matrix;
  std::optional<std::array<double, 3>> translation, scale;
  std::optional<std::array<double, 4>> rotation;  ///< Quaternion xyzw, of any length but 0.
};

/// As the node has it; an error where a rotation has no axis.
NodeTransform node_transform(const GltfValue& node);

Affine affine(const NodeTransform& transform);

}  // namespace nacre::host
