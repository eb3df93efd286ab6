#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <llvm/Target/TargetMachine.h>

#include <memory>
#include <string>

#include "jit/llvm/features.h"
#include "jit/llvm/options.h"

namespace nacre::codegen {

/// What instructions are chosen from: this, and the features that are turned on. The CPU
/// that is meant decides how they are chosen and in what order ("tune-cpu").
inline constexpr const char* baseline_cpu = "x86-64";

/// A machine for one compile job, a baseline_cpu with those features of the target that
/// kernels have a use for; null, with the reason in `error`, where LLVM does not know the
/// CPU or a feature.
std::unique_ptr<llvm::TargetMachine> make_target_machine(const CodegenOptions& options,
                                                         std::string& error);

Features features_of(const llvm::TargetMachine& machine);

}  // namespace nacre::codegen
