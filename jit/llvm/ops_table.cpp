#include <array>

#include "jit/llvm/lookup.h"
#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

llvm::Value* table(FunctionEmitter& e, ValueId id) {
  Builder& b = e.builder();
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  const auto size = e.module().program().tables[instruction.imm].values.size();
  const auto last = static_cast<std::uint32_t>(size - 1);
  llvm::Value* index = e.operand(instruction, 0, lanes);
  index = b.CreateBinaryIntrinsic(llvm::Intrinsic::smax, index, e.i32(0, lanes));
  index = b.CreateBinaryIntrinsic(llvm::Intrinsic::umin, index, e.i32(last, lanes));
  return look_up(e, instruction.imm, index, lanes);
}

constexpr std::array<std::pair<Op, EmitOp>, 1> group{{{Op::table, table}}};

}  // namespace

OpGroup table_ops() { return group; }

}  // namespace nacre::codegen
