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

/// The first `count` places of a sequence, for samples that are added until they are enough. The
/// first 2^k, and any 2^k from a multiple of 2^k on, have one place in each dyadic rectangle of
/// area 2^-k, and the middle of any four from a multiple of four on is that of the texel.
///
/// Sobol's first two dimensions (Kollig and Keller, "Efficient Multidimensional Sampling", 2002,
/// section 3.1) with a linear scrambling (Matousek, "On the L2-Discrepancy for Anchored Boxes",
/// 1998) and a digital shift. For waves wider than the texel 8 and 16 of them are at least three
/// times as exact as sample_places.
std::vector<SamplePlace> sample_sequence(int count);

}  // namespace nacre::host
