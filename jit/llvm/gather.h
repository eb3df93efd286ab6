#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <vector>

#include "jit/llvm/function_emitter.h"

namespace nacre::codegen {

/// The 32-bit element `index`, unsigned, of an array for each lane; all are inside.
/// By the CPU's own instruction where Features::fast_gather says so, else lane by lane.
llvm::Value* gather(FunctionEmitter& emitter, Scalar scalar, llvm::Value* array, llvm::Value* index,
                    int lanes);

/// The elements first, first + 1, ... first + count - 1, all inside: one load a
/// lane, or the CPU's gathers of pairs. `count` is 2 or 4, `lanes` 4 or more.
std::vector<llvm::Value*> gather_run(FunctionEmitter& emitter, Scalar scalar, llvm::Value* array,
                                     llvm::Value* first, int lanes, std::size_t count);

}  // namespace nacre::codegen
