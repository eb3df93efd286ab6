#include "examples/render/sampler.h"

namespace nacre::host {

namespace {

struct Hash4 {
  std::uint32_t x, y, z, w;
};

/// pcg4d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering",
/// JCGT 9(3), listing in appendix.
Hash4 pcg4d(Hash4 v) {
  constexpr std::uint32_t a = 1664525u, c = 1013904223u;
  v = {v.x * a + c, v.y * a + c, v.z * a + c, v.w * a + c};
  const auto mix = [&v] {
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
  };
  mix();
  v = {v.x ^ (v.x >> 16), v.y ^ (v.y >> 16), v.z ^ (v.z >> 16), v.w ^ (v.w >> 16)};
  mix();
  return v;
}

std::uint32_t reverse_bits(std::uint32_t v) {
  v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
  v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
  v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(v);
}

/// The second Sobol' dimension, as a function of the reversed index: the Pascal
/// matrix modulo 2, which factors into one step per bit of the bit position
/// (Ahmed 2024, "An Implementation Algorithm of 2D Sobol Sequence Fast, Elegant,
/// and Compact", EGSR).
std::uint32_t sobol_dimension_1(std::uint32_t v) {
  v ^= v << 16;
  v ^= (v & 0x00ff00ffu) << 8;
  v ^= (v & 0x0f0f0f0fu) << 4;
  v ^= (v & 0x33333333u) << 2;
  v ^= (v & 0x55555555u) << 1;
  return v;
}

/// Nested uniform (Owen) scramble by hash, on reversed bits: each bit changes by
/// those below it. Burley 2020, "Practical Hash-based Owen Scrambling", JCGT
/// 9(4), with the constants of its listing after Laine and Karras 2011.
std::uint32_t owen_scramble_reversed(std::uint32_t v, std::uint32_t seed) {
  v += seed;
  v ^= v * 0x6c50b47cu;
  v ^= v * 0xb82f1e52u;
  v ^= v * 0xc7afe638u;
  v ^= v * 0x8d22f6e6u;
  return v;
}

float to_unit(std::uint32_t v) { return static_cast<float>(v >> 8) * 0x1p-24f; }

}  // namespace

Uniform2 uniform2(SamplerKind kind, const SampleKey& key, Draw draw) {
  const std::uint32_t purpose = (key.event << 4) | static_cast<std::uint32_t>(draw);
  const std::uint32_t seed = key.seed + 0x9e3779b9u * key.step;  // 2^32 over the golden ratio
  if (kind == SamplerKind::independent) {
    const Hash4 h = pcg4d({key.pixel, key.sample, purpose, seed});
    return {to_unit(h.x), to_unit(h.y)};
  }
  // Shuffling the index decorrelates the padded pairs; the scramble of each
  // dimension keeps the stratification within a pair.
  const Hash4 h = pcg4d({key.pixel, 0x5eed5eedu, purpose, seed});
  const std::uint32_t index_reversed = owen_scramble_reversed(reverse_bits(key.sample), h.z);
  const std::uint32_t x = index_reversed;  // the first dimension is van der Corput's
  const std::uint32_t y = sobol_dimension_1(index_reversed);
  return {to_unit(reverse_bits(owen_scramble_reversed(reverse_bits(x), h.x))),
          to_unit(reverse_bits(owen_scramble_reversed(reverse_bits(y), h.y)))};
}

}  // namespace nacre::host
