#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <llvm/IR/Module.h>
#include <llvm/IR/PassManager.h>
#include <llvm/Target/TargetMachine.h>

#include "jit/llvm/options.h"

namespace nacre::codegen {

/// LLVM's share of optimisation. Our own passes have done what needs knowledge
/// of the Program; default<O2> after them costs 15 times as much and gains nothing.
/// `analyses` is new, and empty again at the end; its owner knows whether it may be freed
/// where memory runs out.
void optimize(llvm::Module& module, llvm::TargetMachine& machine, Tier tier,
              llvm::FunctionAnalysisManager& analyses);

}  // namespace nacre::codegen
