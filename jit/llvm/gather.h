#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <vector>

#include "jit/llvm/function_emitter.h"

namespace nacre::codegen {

/// Words of 32 bits in memory.
struct Words {
  Scalar scalar;
  llvm::Value* first;
  bool are_many = false;  ///< Unsigned indices may be 2^31 or more.
};

/// The element `index` for each lane; all are inside. By the CPU's own instruction where
/// Features::fast_gather says so, else lane by lane.
llvm::Value* gather(FunctionEmitter& emitter, const Words& words, llvm::Value* index, int lanes);

/// The elements first, first + 1, ... first + count - 1, all inside: one load a
/// lane, or the CPU's gathers of pairs. `count` is 2 or 4, `lanes` 4 or more.
std::vector<llvm::Value*> gather_run(FunctionEmitter& emitter, const Words& words,
                                     llvm::Value* first, int lanes, std::size_t count);

}  // namespace nacre::codegen
