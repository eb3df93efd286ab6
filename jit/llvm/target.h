#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <llvm/Target/TargetMachine.h>

#include <memory>
#include <string>

#include "jit/llvm/features.h"
#include "jit/llvm/options.h"

namespace nacre::codegen {

/// A machine for one compile job; null, with the reason in `error`, where LLVM
/// does not know the CPU.
std::unique_ptr<llvm::TargetMachine> make_target_machine(const CodegenOptions& options,
                                                         std::string& error);

Features features_of(const llvm::TargetMachine& machine);

}  // namespace nacre::codegen
