#include <array>

#include "jit/llvm/function_emitter.h"
#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

using Table = std::array<EmitOp, op_count>;

Table make_table() {
  Table table{};
  for (const auto& group : {leaf_ops(), float_ops(), integer_ops(), conversion_ops(), table_ops(),
                            texel_ops(), region_ops(), call_ops()}) {
    for (const auto& [op, emit] : group) table[static_cast<std::size_t>(op)] = emit;
  }
  return table;
}

}  // namespace

EmitOp emit_op(Op op) {
  static const Table table = make_table();
  return table[static_cast<std::size_t>(op)];
}

}  // namespace nacre::codegen
