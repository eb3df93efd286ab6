#pragma once

#include <vector>

namespace nacre::host {

/// A place in a texel, from 0 to 1 along both axes.
struct SamplePlace {
  float x = 0.5f;
  float y = 0.5f;
};

/// The places of `count` samples: Hammersley's set, moved to the middles of its strata. Of
/// each axis's `count` equal parts, each has one place along x and, for powers of two, along y;
/// then each dyadic rectangle of area 1/count has one, too. One sample is in the middle.
std::vector<SamplePlace> sample_places(int count);

}  // namespace nacre::host
