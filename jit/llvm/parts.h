#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "jit/llvm/options.h"
#include "runtime/program/program.h"

namespace nacre::codegen {

/// How an entry is cut into functions of bounded size: what LLVM takes for a function grows
/// faster than the function. Values that one of them makes and another needs lie in a frame
/// in memory meanwhile.
struct Parts {
  static constexpr std::uint32_t nowhere = ~0u;

  std::uint32_t count = 0;           ///< 0: it is not cut.
  std::vector<std::uint32_t> home;   ///< By instruction: its part, from 1 on; 0: the entry itself.
  std::vector<std::uint32_t> place;  ///< By value: its offset in the frame, or nowhere.
  std::size_t frame_bytes = 0;

  bool same_home(ValueId a, ValueId b) const { return count == 0 || home[a] == home[b]; }
};

/// As the options say. What is computed `once` (see once_per_call) comes first. A region that
/// is larger than a part stays in the entry, and is cut inside.
Parts cut_into_parts(const Function& entry, const std::vector<bool>& once,
                     const CodegenOptions& options);

}  // namespace nacre::codegen
