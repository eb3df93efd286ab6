#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <llvm/IR/DIBuilder.h>

#include <cstddef>

#include "jit/llvm/llvm.h"

namespace nacre::codegen {

/// Says of each machine instruction which instruction of the Program it is for, in DWARF:
/// function k of the Program is a file of the name "k", and its instruction i line i + 1.
/// Profilers and debuggers show it; CodeMap reads it. No other code comes out.
class LineTable {
 public:
  explicit LineTable(llvm::Module& module);

  /// What the lines of `into` are in, which is made of function `index`.
  llvm::DISubprogram* begin(llvm::Function& into, std::size_t index);
  /// Once all is emitted.
  void finish() { builder_.finalize(); }

 private:
  llvm::DIBuilder builder_;
};

}  // namespace nacre::codegen
