#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include "jit/llvm/module_emitter.h"

namespace nacre::codegen {

/// Fills `into`, `void(const KernelArguments*)`, with the Program's entry: what
/// is uniform at top level, once; then a loop over whole batches of W points.
/// The count must be a multiple of W and not 0: run_code() sees to that.
void emit_entry(ModuleEmitter& module, llvm::Function& into);

}  // namespace nacre::codegen
