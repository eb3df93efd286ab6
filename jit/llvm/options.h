#pragma once

#include <cstdint>
#include <string>

#include "runtime/program/cost.h"
#include "runtime/program/program.h"

namespace nacre {

/// The CPU that code is made for, in LLVM's words. Code uses no more than what kernels
/// gain from, up to x86-64-v4; other features count for nothing, named or of the CPU.
struct Target {
  std::string cpu;       ///< "znver4", "x86-64-v3", ...
  std::string features;  ///< "+avx2,-avx512f,...": on top of the CPU's own.

  /// This machine, with those features that it really has.
  static Target host();
  /// A CPU by name with the features that name implies.
  static Target named(std::string cpu) { return {std::move(cpu), {}}; }

  bool operator==(const Target&) const = default;
};

/// How much time code generation may take.
enum class Tier : std::uint8_t {
  quick,  ///< LLVM's level None: 3 to 5 times faster to compile, slower code.
  full,   ///< LLVM's level Default.
};

/// Whether there is code of so many lanes: 1, 4, 8 or 16.
constexpr bool is_lane_count(int lanes) {
  return lanes == 1 || lanes == 4 || lanes == 8 || lanes == 16;
}

/// The number of lanes that is fastest on a CPU: 16 with AVX-512, 8 with AVX, else 4.
int widest_lanes(const Target& target);

/// Everything besides the Program that decides what code comes out.
struct CodegenOptions {
  int lanes = 16;  ///< Points in one pass of the code: 1, 4, 8 or 16.
  Target target = Target::host();
  /// `fast` lets LLVM reassociate, contract and ignore the sign of zero. No mode
  /// assumes that there are no NaN or infinities.
  Accuracy accuracy = Accuracy::standard;
  Tier tier = Tier::full;
  /// Beyond what a pass may take at most, code counts; see runtime/program/cost.h. Which
  /// limit it is does not change the code.
  std::uint64_t max_steps = default_max_steps;

  /// An entry of more than `uncut` instructions becomes functions of up to `part` of them, so
  /// that LLVM's time grows with the size, and no faster. The results are the same.
  std::uint32_t uncut = 20'000;
  std::uint32_t part = 2'000;
  /// Say of the code which instruction of the Program it is for: see CodeMap.
  bool line_tables = false;

  /// A text that is equal for equal options only; part of the cache's key.
  std::string key() const;
};

}  // namespace nacre
