#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "bench/peers/peers.h"

namespace {

using Batch = xsimd::batch<float>;
using Bits = xsimd::batch<std::uint32_t>;

Bits rotate(Bits x, int count) { return (x << count) | (x >> (32 - count)); }

/// lookup3 of three integers (Jenkins, 2006).
Bits hash(Bits x, Bits y, Bits z) {
  const Bits seed(0xdeadbeefu + (3u << 2) + 13u);
  Bits a = seed + x;
  Bits b = seed + y;
  Bits c = seed + z;
  c = (c ^ b) - rotate(b, 14);
  a = (a ^ c) - rotate(c, 11);
  b = (b ^ a) - rotate(a, 25);
  c = (c ^ b) - rotate(b, 16);
  a = (a ^ c) - rotate(c, 4);
  b = (b ^ a) - rotate(a, 14);
  return (c ^ b) - rotate(b, 24);
}

/// -x where `bit` (at `shift` from the top) is set: the sign is flipped.
Batch flip(Batch x, Bits hash, int shift) {
  const Bits sign = (hash << shift) & Bits(0x80000000u);
  return xsimd::bitwise_cast<Batch>(xsimd::bitwise_cast<Bits>(x) ^ sign);
}

/// Masks of integer comparisons choose floats.
Batch choose(xsimd::batch_bool<std::uint32_t> mask, Batch a, Batch b) {
  return xsimd::bitwise_cast<Batch>(
      xsimd::select(mask, xsimd::bitwise_cast<Bits>(a), xsimd::bitwise_cast<Bits>(b)));
}

Batch gradient(Bits hash, Batch x, Batch y, Batch z) {
  const Bits h = hash & Bits(15u);
  const Batch u = choose(h < Bits(8u), x, y);
  const Batch v = choose(h < Bits(4u), y, choose((h & Bits(13u)) == Bits(12u), x, z));
  return flip(u, h, 31) + flip(v, h, 30);
}

Batch fade(Batch t) {
  return t * t * t * xsimd::fma(t, xsimd::fma(t, Batch(6.0f), Batch(-15.0f)), Batch(10.0f));
}
Batch mix(Batch a, Batch b, Batch t) { return xsimd::fma(t, b, xsimd::fnma(t, a, a)); }

Batch perlin(Batch x, Batch y, Batch z) {
  const Batch lx = xsimd::floor(x);
  const Batch ly = xsimd::floor(y);
  const Batch lz = xsimd::floor(z);
  const Bits ix = xsimd::bitwise_cast<Bits>(xsimd::to_int(lx));
  const Bits iy = xsimd::bitwise_cast<Bits>(xsimd::to_int(ly));
  const Bits iz = xsimd::bitwise_cast<Bits>(xsimd::to_int(lz));
  const Batch fx = x - lx;
  const Batch fy = y - ly;
  const Batch fz = z - lz;
  const auto corner = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return gradient(hash(ix + Bits(i), iy + Bits(j), iz + Bits(k)),
                    fx - Batch(static_cast<float>(i)), fy - Batch(static_cast<float>(j)),
                    fz - Batch(static_cast<float>(k)));
  };
  const Batch u = fade(fx);
  const Batch v = fade(fy);
  const Batch w = fade(fz);
  const auto edge = [&](std::uint32_t j, std::uint32_t k) {
    return mix(corner(0, j, k), corner(1, j, k), u);
  };
  const auto face = [&](std::uint32_t k) { return mix(edge(0, k), edge(1, k), v); };
  return Batch(0.9820f) * mix(face(0), face(1), w);
}

}  // namespace

extern "C" void nacre_peer_fractal(const float* x, const float* y, const float* z, float* out,
                                   std::size_t count) {
  for (std::size_t i = 0; i < count; i += Batch::size) {
    Batch px = Batch::load_unaligned(x + i);
    Batch py = Batch::load_unaligned(y + i);
    Batch pz = Batch::load_unaligned(z + i);
    Batch sum(0.0f);
    float amplitude = 1.0f;
    for (int octave = 0; octave < 4; ++octave) {
      sum = xsimd::fma(Batch(amplitude), perlin(px, py, pz), sum);
      amplitude *= 0.5f;
      px = px * Batch(2.0f);
      py = py * Batch(2.0f);
      pz = pz * Batch(2.0f);
    }
    sum.store_unaligned(out + i);
  }
}
