#include "bench/accuracy/pairs.h"

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace nacre {

namespace {

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): number `stream` of an index.
std::uint64_t random_word(std::uint64_t index, std::uint64_t stream) {
  std::uint64_t z = (index * 4 + stream + 1) * 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

/// In [0, 1).
double uniform(std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; }

std::uint32_t to_bits(double x) { return std::bit_cast<std::uint32_t>(static_cast<float>(x)); }

std::vector<std::uint32_t> make_edges() {
  std::vector<std::uint32_t> edges;
  const auto add = [&](float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (const std::uint32_t near : {bits - 1, bits, bits + 1}) {
      edges.push_back(near);
      edges.push_back(near ^ 0x80000000u);
    }
  };
  for (int exponent = -126; exponent <= 127; exponent += 11) add(std::ldexp(1.0f, exponent));
  for (const float value :
       {0.5f,       2.0f / 3.0f, 0.75f,       1.0f,        4.0f / 3.0f, 1.5f,   2.0f,   2.5f,
        3.0f,       5.0f,        10.0f,       0.41421357f, 2.4142135f,  127.0f, 128.0f, 8388607.0f,
        8388609.0f, 16777215.0f, 16777216.0f, 1e10f,       1e-10f,      1e30f,  1e-30f}) {
    add(value);
  }
  for (const std::uint32_t bits : {0x00000000u, 0x00000001u, 0x007fffffu, 0x00800000u, 0x7f7fffffu,
                                   0x7f800000u, 0x7fc00000u, 0x7f800001u}) {
    edges.push_back(bits);
    edges.push_back(bits | 0x80000000u);
  }
  return edges;
}

const std::vector<std::uint32_t>& edges() {
  static const std::vector<std::uint32_t> list = make_edges();
  return list;
}

/// A number of any exponent within 2^-reach ... 2^reach.
double spread(std::uint64_t word, double reach) {
  return std::exp2((2.0 * uniform(word) - 1.0) * reach);
}

/// An exponent that makes base^exponent some power of two within 2^+-140.
double exponent_for(double base, std::uint64_t word) {
  return (2.0 * uniform(word) - 1.0) * 140.0 / std::log2(base);
}

Pair pow_pair(std::uint64_t kind, std::uint64_t a, std::uint64_t b) {
  if (kind == 3) return {to_bits(uniform(a)), to_bits(20.0 * uniform(b))};
  const double near_one = 1.0 + (uniform(a) - 0.5) * std::exp2(-static_cast<double>(a & 15u));
  const double wide = spread(a, 125.0);
  const float base = static_cast<float>(kind == 1 ? near_one : wide);
  return {std::bit_cast<std::uint32_t>(base), to_bits(exponent_for(base, b))};
}

Pair atan2_pair(std::uint64_t kind, std::uint64_t a, std::uint64_t b) {
  if (kind == 3) return {to_bits(2.0 * uniform(a) - 1.0), to_bits(2.0 * uniform(b) - 1.0)};
  const double size = spread(a, 95.0);
  const double ratio = kind == 1 ? 1.0 + (uniform(b) - 0.5) * 0.1 : spread(b, 30.0);
  const std::uint32_t signs = static_cast<std::uint32_t>(a) << 31;
  return {to_bits(size * ratio) ^ signs, to_bits((b & 1u) != 0 ? size : -size)};
}

}  // namespace

std::uint64_t edge_pair_count() { return edges().size() * edges().size(); }

Pair pair_of(Op op, std::uint64_t index) {
  const auto& list = edges();
  if (index < edge_pair_count()) return {list[index / list.size()], list[index % list.size()]};
  const std::uint64_t a = random_word(index, 0);
  const std::uint64_t b = random_word(index, 1);
  const std::uint64_t kind = index % 4;
  if (kind == 0) return {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)};
  return op == Op::pow ? pow_pair(kind, a, b) : atan2_pair(kind, a, b);
}

}  // namespace nacre
