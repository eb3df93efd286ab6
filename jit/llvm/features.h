#pragma once

#include <string>

namespace nacre::codegen {

/// The x86 features that the emitter asks about.
struct Features {
  bool ssse3 = false;
  bool avx = false;
  bool avx2 = false;
  bool f16c = false;
  bool avx512 = false;  ///< F, BW, CD, DQ and VL at 512 bits: masks are native at every width.
  /// There are instructions that gather, with AVX-512, and LLVM calls them fast: Intel's are, while
  /// those of Zen 4 take half as long again as loads do.
  bool fast_gather = false;
  std::string all = {};  ///< Of the machine, in LLVM's words; on top of baseline_cpu.
};

}  // namespace nacre::codegen
