#pragma once

#include <cstdint>
#include <span>

#include "runtime/program/op.h"

namespace nacre {

/// Pair `index` of arguments for pow or atan2, as bits, the same every time.
/// First all pairs of edge values: zeros, ones and their neighbours, powers of
/// two, whole and half numbers, the ends of the range, infinities, NaN. Then,
/// in turn: any bits; for pow, bases near 1 with exponents that bring the
/// result near the ends of the range, any base with such an exponent, and what
/// shading asks for (base in [0, 1], exponent to 20); for atan2, ratios near 1,
/// ratios of up to 2^30, and points of the square [-1, 1].
struct Pair {
  std::uint32_t x;
  std::uint32_t y;
};
Pair pair_of(Op op, std::uint64_t index);

/// How many pairs of edge values there are.
std::uint64_t edge_pair_count();

}  // namespace nacre
