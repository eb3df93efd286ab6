#pragma once

#include <string>
#include <string_view>

namespace nacre::codegen {

/// The x86 features that the emitter asks about.
struct Features {
  bool ssse3 = false;
  bool avx = false;
  bool avx2 = false;
  bool f16c = false;
  bool avx512 = false;  ///< F, BW, CD, DQ and VL at 512 bits: masks are native at every width.
  /// There are instructions that gather, with AVX-512, and LLVM calls them fast: Intel's, which
  /// bench/results/textures.md has, and of AMD none.
  bool fast_gather = false;
  std::string all = {};  ///< Of the machine, in LLVM's words; on top of baseline_cpu.
};

/// Whether the CPU's microcode leaves gathers as quick as they are: it makes them slow where
/// others' data could be read by them (INTEL-SA-00828). By what Linux says of that in
/// gather_data_sampling, Documentation/admin-guide/hw-vuln/gather_data_sampling.rst; where it does
/// not know, as in virtual machines on such CPUs, or is too old to say, they are taken for slow.
bool gathers_are_not_slowed(std::string_view linux_says);

}  // namespace nacre::codegen
