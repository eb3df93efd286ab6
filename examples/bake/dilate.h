#pragma once

#include <cstdint>
#include <vector>

namespace nacre::host {

/// How texels of a map get values that have nothing of the surface.
struct Dilation {
  /// So many columns and rows from a texel of the surface they are what the next one is, by their
  /// middles; beyond that 0, or as `fills` says.
  int texels = 4;
  /// The rest is the mean of what is in the smallest square around, of 2, 4, 8, ... texels along
  /// its sides at a multiple of that, that is not empty: so the means that mip levels are of are
  /// made of the surface alone (Gortler et al. 1996, "The Lumigraph", section 3.4.2, with a box
  /// for a filter).
  bool fills = true;
};

/// Dilates each of some planes of width texels a row. `covered`: 1 of texels that have a value.
/// What is not finite is never taken for a value beyond its texel.
void dilate(std::vector<std::vector<float>>& planes, const std::vector<std::uint8_t>& covered,
            int width, const Dilation& dilation);

}  // namespace nacre::host
