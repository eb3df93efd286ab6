#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "examples/render/scene.h"

namespace nacre::host {

/// Solids that may lie within one another, by mesh; both are empty where there are none.
struct NestedSolids {
  std::vector<bool> solid;   ///< Closed, and light enters it.
  std::vector<bool> within;  ///< May lie in such a solid: their boxes overlap.
};

/// Whether boxes of two closed meshes that `lets_in` light overlap, or of two instances of one, and
/// which meshes that concerns then. By where they are before anything is displaced. `lets_in` is
/// asked once of each mesh whose box overlaps another.
NestedSolids find_nested_solids(const Scene& scene,
                                const std::function<bool(std::uint32_t mesh)>& lets_in);

}  // namespace nacre::host
