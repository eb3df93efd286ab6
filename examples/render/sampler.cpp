#include "examples/render/sampler.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace nacre::host {

namespace {

struct Hash4 {
  std::uint32_t x, y, z, w;
};

/// pcg4d of Jarzynski and Olano 2020, "Hash Functions for GPU Rendering",
/// JCGT 9(3), listing in appendix.
[[gnu::always_inline]] inline Hash4 pcg4d(Hash4 v) {
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

[[gnu::always_inline]] inline std::uint32_t reverse_bits(std::uint32_t v) {
  v = ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
  v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
  v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
  v = ((v >> 8) & 0x00ff00ffu) | ((v & 0x00ff00ffu) << 8);
  return (v >> 16) | (v << 16);
}

/// The second Sobol' dimension, as a function of the reversed index: the Pascal
/// matrix modulo 2, which factors into one step per bit of the bit position
/// (Ahmed 2024, "An Implementation Algorithm of 2D Sobol Sequence Fast, Elegant,
/// and Compact", EGSR).
[[gnu::always_inline]] inline std::uint32_t sobol_dimension_1(std::uint32_t v) {
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
[[gnu::always_inline]] inline std::uint32_t owen_scramble_reversed(std::uint32_t v,
                                                                   std::uint32_t seed) {
  v += seed;
  v ^= v * 0x6c50b47cu;
  v ^= v * 0xb82f1e52u;
  v ^= v * 0xc7afe638u;
  v ^= v * 0x8d22f6e6u;
  return v;
}

[[gnu::always_inline]] inline float to_unit(std::uint32_t v) {
  return static_cast<float>(static_cast<std::int32_t>(v >> 8)) * 0x1p-24f;
}

/// What a pair is made of: its key, in numbers that are hashed.
struct Seeds {
  std::uint32_t pixel, sample, purpose, seed;
};

[[gnu::always_inline]] inline Seeds seeds_of(const SampleKey& key, Draw draw) {
  return {key.pixel, key.sample, (key.event << 4) | static_cast<std::uint32_t>(draw),
          key.seed + 0x9e3779b9u * key.step};  // 2^32 over the golden ratio
}

[[gnu::always_inline]] inline Uniform2 independent(const Seeds& s) {
  const Hash4 h = pcg4d({s.pixel, s.sample, s.purpose, s.seed});
  return {to_unit(h.x), to_unit(h.y)};
}

/// Shuffling the index decorrelates the padded pairs; the scramble of each dimension keeps the
/// stratification within a pair.
[[gnu::always_inline]] inline Uniform2 sobol(const Seeds& s) {
  const Hash4 h = pcg4d({s.pixel, 0x5eed5eedu, s.purpose, s.seed});
  const std::uint32_t index_reversed = owen_scramble_reversed(reverse_bits(s.sample), h.z);
  const std::uint32_t x = index_reversed;  // the first dimension is van der Corput's
  const std::uint32_t y = sobol_dimension_1(index_reversed);
  return {to_unit(reverse_bits(owen_scramble_reversed(reverse_bits(x), h.x))),
          to_unit(reverse_bits(owen_scramble_reversed(reverse_bits(y), h.y)))};
}

/// Pairs that are made together, each part of them in an array of its own.
constexpr std::size_t block_size = 64;
struct Block {
  alignas(64) std::uint32_t pixel[block_size], sample[block_size], purpose[block_size],
      seed[block_size];
  alignas(64) float x[block_size], y[block_size];
};

/// Whole blocks, so that compilers make lanes of it.
[[gnu::always_inline]] inline void make_sobol(Block& b) {
  for (std::size_t i = 0; i < block_size; ++i) {
    const Uniform2 u = sobol({b.pixel[i], b.sample[i], b.purpose[i], b.seed[i]});
    b.x[i] = u.x;
    b.y[i] = u.y;
  }
}

using Make = void (*)(Block&);

void make_plain(Block& b) { make_sobol(b); }

#ifdef __x86_64__
[[gnu::target("avx2")]] void make_avx2(Block& b) { make_sobol(b); }
#endif

Make fastest_make() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return make_avx2;
#endif
  return make_plain;
}

}  // namespace

Uniform2 uniform2(SamplerKind kind, const SampleKey& key, Draw draw) {
  const Seeds seeds = seeds_of(key, draw);
  return kind == SamplerKind::independent ? independent(seeds) : sobol(seeds);
}

void uniform2(SamplerKind kind, std::span<const SampleKey> keys, Draw draw,
              std::span<Uniform2> numbers) {
  assert(keys.size() == numbers.size());
  if (kind == SamplerKind::independent) {
    for (std::size_t i = 0; i < keys.size(); ++i) numbers[i] = uniform2(kind, keys[i], draw);
    return;
  }
  static const Make make = fastest_make();
  Block b{};
  for (std::size_t first = 0; first < keys.size(); first += block_size) {
    const std::size_t count = std::min(block_size, keys.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Seeds s = seeds_of(keys[first + i], draw);
      b.pixel[i] = s.pixel;
      b.sample[i] = s.sample;
      b.purpose[i] = s.purpose;
      b.seed[i] = s.seed;
    }
    make(b);
    for (std::size_t i = 0; i < count; ++i) numbers[first + i] = {b.x[i], b.y[i]};
  }
}

}  // namespace nacre::host
