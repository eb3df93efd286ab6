#pragma once

#include <cstdint>

namespace nacre {

/// One to one, each bit of it of all bits: SplitMix64's finaliser (Steele, Lea, Flood 2014, "Fast
/// Splittable Pseudorandom Number Generators", figure 16: mix64variant13).
constexpr std::uint64_t mix_bits(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

}  // namespace nacre
