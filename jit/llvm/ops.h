#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <span>
#include <utility>

#include "jit/llvm/function_emitter.h"

namespace nacre::codegen {

/// Operations and how they are emitted; one file a group.
using OpGroup = std::span<const std::pair<Op, EmitOp>>;

OpGroup leaf_ops();
OpGroup float_ops();
OpGroup integer_ops();
OpGroup conversion_ops();
OpGroup region_ops();
OpGroup call_ops();
OpGroup table_ops();
OpGroup texel_ops();

}  // namespace nacre::codegen
