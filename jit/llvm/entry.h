#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include "jit/llvm/module_emitter.h"

namespace nacre::codegen {

/// Fills `into`, `void(const KernelArguments*)`, with the Program's entry:
///
///   what is uniform at top level, once
///   for each batch of W points
///     a full batch works on the host's arrays;
///     the last, if points are missing, on copies filled up with zeros
///
/// so the body is there only once, and nothing beyond the arrays is touched.
void emit_entry(ModuleEmitter& module, llvm::Function& into);

}  // namespace nacre::codegen
