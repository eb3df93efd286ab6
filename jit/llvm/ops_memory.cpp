#include <algorithm>
#include <array>
#include <cstddef>

#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

Value* lane(Builder& b, Value* value, int k) {
  if (!value->getType()->isVectorTy()) return value;
  return b.CreateExtractElement(value, static_cast<std::uint64_t>(k));
}

/// load(k) for every lane k, put together.
template <class F>
Value* each_lane(FunctionEmitter& e, Scalar scalar, int lanes, F&& load) {
  if (lanes == 1) return load(0);
  Value* all = llvm::PoisonValue::get(e.module().type(scalar, lanes));
  for (int k = 0; k < lanes; ++k) {
    all = e.builder().CreateInsertElement(all, load(k), static_cast<std::uint64_t>(k));
  }
  return all;
}

Value* table(FunctionEmitter& e, ValueId id) {
  Builder& b = e.builder();
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  const auto size = e.module().program().tables[instruction.imm].values.size();
  Value* index = e.operand(instruction, 0, lanes);
  index = b.CreateBinaryIntrinsic(llvm::Intrinsic::smax, index, e.i32(0, lanes));
  index = b.CreateBinaryIntrinsic(llvm::Intrinsic::umin, index,
                                  e.i32(static_cast<std::uint32_t>(size - 1), lanes));
  Value* data = e.module().table_data(instruction.imm);
  return each_lane(e, Scalar::f32, lanes, [&](int k) {
    Value* wide = b.CreateZExt(lane(b, index, k), b.getInt64Ty());
    return e.load_invariant(b.getFloatTy(), b.CreateInBoundsGEP(b.getFloatTy(), data, wide));
  });
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
                     [&](int k) { return load(binding.words, lane(b, index, k)); });
  }
  Value* slot = e.use(slot_id, lanes);
  return each_lane(e, Scalar::i32, lanes, [&](int k) {
    const Binding binding = load_binding(e, lane(b, slot, k));
    Value* own = lane(b, word, k);
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
