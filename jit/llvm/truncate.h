#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include "jit/llvm/function_emitter.h"

namespace nacre::codegen {

/// Op::f_to_i of x, a vector of `lanes` or a scalar.
llvm::Value* truncate_saturated(FunctionEmitter& emitter, llvm::Value* x, int lanes);

}  // namespace nacre::codegen
