#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <vector>

#include "jit/llvm/llvm.h"
#include "runtime/program/program.h"

namespace nacre::codegen {

/// A merge of an if_any region.
struct Merge {
  ValueId id;
  llvm::Value* skipped;  ///< Its value where the region does not run.
};

/// A carry of a loop region.
struct Carry {
  ValueId id;
  llvm::PHINode* phi;
  llvm::Value* initial;
  ValueId next = no_value;
};

/// An if_any or loop while its instructions are emitted:
///
///   before -> body -> after         before -> header ... latch -> after
///      \_______________/               \________^________/ \_______/
struct Region {
  ValueId open;
  llvm::BasicBlock* before;  ///< Ends in the branch into or around the region.
  llvm::BasicBlock* after;
  bool always;  ///< Nothing branches around it: the mask is a literal true.
  std::vector<Merge> merges;

  // Loops only.
  llvm::BasicBlock* header = nullptr;
  llvm::PHINode* iteration = nullptr;
  llvm::PHINode* active = nullptr;  ///< Lanes that go on; null in a uniform loop.
  llvm::Value* again = nullptr;     ///< Lanes that go on after this iteration.
  std::vector<Carry> carries;
};

}  // namespace nacre::codegen
