#include <algorithm>
#include <array>
#include <cstddef>

#include "jit/llvm/lanes.h"
#include "jit/llvm/lookup.h"
#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

Value* table(FunctionEmitter& e, ValueId id) {
  Builder& b = e.builder();
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  const auto size = e.module().program().tables[instruction.imm].values.size();
  Value* index = e.operand(instruction, 0, lanes);
  index = b.CreateBinaryIntrinsic(llvm::Intrinsic::smax, index, e.i32(0, lanes));
  index = b.CreateBinaryIntrinsic(llvm::Intrinsic::umin, index,
                                  e.i32(static_cast<std::uint32_t>(size - 1), lanes));
  return look_up(e, instruction.imm, index, lanes);
}

/// A texture's first word, and the number of the last that 32 bits reach.
struct Binding {
  Value* words;
  Value* last;
};

Binding load_binding(FunctionEmitter& e, Value* slot) {
  Builder& b = e.builder();
  Value* textures = e.load_invariant(
      b.getPtrTy(), e.byte_offset(e.kernel_arguments, offsetof(KernelArguments, textures)));
  const auto known = static_cast<std::uint32_t>(e.module().program().textures.size());
  Value* number = b.CreateSelect(b.CreateICmpULT(slot, e.i32(known)), slot, e.i32(0));
  Value* offset =
      b.CreateMul(b.CreateZExt(number, b.getInt64Ty()), b.getInt64(sizeof(TextureBinding)));
  Value* binding = b.CreateInBoundsGEP(b.getInt8Ty(), textures, offset);
  Value* words =
      e.load_invariant(b.getPtrTy(), e.byte_offset(binding, offsetof(TextureBinding, words)));
  Value* count =
      e.load_invariant(b.getInt64Ty(), e.byte_offset(binding, offsetof(TextureBinding, count)));
  // A texture of no words still has word 0, by the contract.
  Value* from_one = b.CreateBinaryIntrinsic(llvm::Intrinsic::umax, count, b.getInt64(1));
  Value* last = b.CreateBinaryIntrinsic(llvm::Intrinsic::umin, b.CreateSub(from_one, b.getInt64(1)),
                                        b.getInt64(~0u));
  return {words, b.CreateTrunc(last, b.getInt32Ty())};
}

Value* texel(FunctionEmitter& e, ValueId id) {
  Builder& b = e.builder();
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  const ValueId slot_id = instruction.operands[0];
  Value* word = e.operand(instruction, 1, lanes);
  const auto load = [&](Value* words, Value* index) {
    Value* wide = b.CreateZExt(index, b.getInt64Ty());
    return e.load_invariant(b.getInt32Ty(), b.CreateInBoundsGEP(b.getInt32Ty(), words, wide));
  };
  if (!e.is_wide(slot_id)) {
    const Binding binding = load_binding(e, e.use(slot_id, 1));
    Value* inside = b.CreateICmpULE(word, e.spread(binding.last, lanes));
    Value* index = b.CreateSelect(inside, word, e.i32(0, lanes));
    return each_lane(e, Scalar::i32, lanes,
                     [&](int k) { return load(binding.words, lane(e, index, k)); });
  }
  Value* slot = e.use(slot_id, lanes);
  return each_lane(e, Scalar::i32, lanes, [&](int k) {
    const Binding binding = load_binding(e, lane(e, slot, k));
    Value* own = lane(e, word, k);
    return load(binding.words, b.CreateSelect(b.CreateICmpULE(own, binding.last), own, e.i32(0)));
  });
}

constexpr std::array<std::pair<Op, EmitOp>, 2> group{{
    {Op::table, table},
    {Op::texel, texel},
}};

}  // namespace

OpGroup memory_ops() { return group; }

}  // namespace nacre::codegen
