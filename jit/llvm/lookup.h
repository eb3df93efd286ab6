#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <vector>

#include "jit/llvm/function_emitter.h"

namespace nacre::codegen {

/// Whether the CPU holds a table of so many entries in registers and permutes them.
/// On Zen 4 that takes a sixth of the time of loads.
bool fits_registers(const Features& features, std::size_t entries, int lanes);

/// Whether that is one instruction, which looks at the bits of an index that tell the entries
/// apart and at no others.
bool ignores_high_bits(const Features& features, std::size_t entries, int lanes);

/// Entry `index` of a constant table that does, for each lane; the index is in range.
llvm::Value* look_up_in_registers(FunctionEmitter& emitter, const std::vector<float>& values,
                                  llvm::Value* index, int lanes);

/// Number `index` of a row in memory, for each lane; the index is in range. There is room for
/// row_room() of them.
llvm::Value* look_up_in_row(FunctionEmitter& emitter, llvm::Value* row, std::uint32_t count,
                            llvm::Value* index, int lanes);
/// `count` and what is loaded beyond.
std::uint32_t row_room(std::uint32_t count);

}  // namespace nacre::codegen
