#pragma once

#include <vector>

namespace nacre::host {

/// A place in a texel, from 0 to 1 along both axes.
struct SamplePlace {
  float x = 0.5f;
  float y = 0.5f;
};

/// The places of `count` samples. Each of `count` equal parts of the x axis has one. For powers
/// of two it is Hammersley's set, moved to the middles of its strata: so have parts of the y axis,
/// and dyadic rectangles of area 1/count. For other numbers y goes on by the golden ratio. One
/// sample is in the middle.
std::vector<SamplePlace> sample_places(int count);

}  // namespace nacre::host
