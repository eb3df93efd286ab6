#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include "jit/llvm/function_emitter.h"

namespace nacre::codegen {

/// Entry `index` of a constant table for each lane; the index is in range. Small
/// tables stay in registers, where the CPU can permute them: on Zen 4 that takes
/// a sixth of the time of loads. Others are loaded from, lane by lane.
llvm::Value* look_up(FunctionEmitter& emitter, std::uint32_t table, llvm::Value* index, int lanes);

}  // namespace nacre::codegen
