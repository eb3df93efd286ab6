#pragma once

#include <cstdint>
#include <vector>

namespace nacre {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): the same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t word() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /// 0 ... below - 1.
  std::uint32_t below(std::uint32_t limit) {
    return static_cast<std::uint32_t>((word() >> 32) * limit >> 32);
  }
  bool chance(double probability) {
    return static_cast<double>(word() >> 11) * 0x1p-53 < probability;
  }
  template <class T>
  const T& pick(const std::vector<T>& list) {
    return list[below(static_cast<std::uint32_t>(list.size()))];
  }

 private:
  std::uint64_t state_;
};

}  // namespace nacre
