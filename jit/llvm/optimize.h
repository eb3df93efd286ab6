#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <llvm/IR/Module.h>
#include <llvm/Target/TargetMachine.h>

#include "jit/llvm/options.h"

namespace nacre::codegen {

/// LLVM's share of optimisation. Our own passes have done what needs knowledge
/// of the Program; default<O2> after them costs 15 times as much and gains nothing.
void optimize(llvm::Module& module, llvm::TargetMachine& machine, Tier tier);

}  // namespace nacre::codegen
