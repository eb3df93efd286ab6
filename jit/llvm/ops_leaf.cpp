#include <array>
#include <cstddef>

#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

// Constants become operands where they are used.
Value* constant(FunctionEmitter&, ValueId) { return nullptr; }

/// A word of memory as a value of its type; f32 denormals read as zero.
Value* from_word(FunctionEmitter& e, Value* address, Scalar scalar, int lanes) {
  const bool is_bool = scalar == Scalar::b1;
  Value* word = e.load_invariant(e.module().type(is_bool ? Scalar::i32 : scalar, lanes), address);
  if (scalar == Scalar::f32) return e.flush(word);
  if (is_bool) return e.builder().CreateICmpNE(word, e.i32(0, lanes));
  return word;
}

Value* parameter(FunctionEmitter& e, ValueId id) {
  Value* block = e.load_invariant(
      e.builder().getPtrTy(),
      e.byte_offset(e.kernel_arguments, offsetof(KernelArguments, parameters)), "parameters");
  const Instruction& instruction = e.at(id);
  Value* word = from_word(e, e.byte_offset(block, instruction.imm * 4u), instruction.type, 1);
  return e.spread(word, e.lanes_of(id));
}

/// Where the batch's first point stands in a channel's array.
Value* batch_address(FunctionEmitter& e, Value* arrays, std::uint32_t channel) {
  Builder& b = e.builder();
  Value* base = e.load_invariant(b.getPtrTy(), e.byte_offset(arrays, channel * sizeof(void*)));
  return b.CreateInBoundsGEP(b.getInt32Ty(), base, e.first_point);
}

Value* input(FunctionEmitter& e, ValueId id) {
  const Instruction& instruction = e.at(id);
  Value* address = batch_address(e, e.input_pointers, instruction.imm);
  return from_word(e, address, instruction.type, e.lanes());
}

Value* store(FunctionEmitter& e, ValueId id) {
  Builder& b = e.builder();
  const Instruction& instruction = e.at(id);
  const ValueId source = instruction.operands[0];
  Value* value = e.use(source, e.lanes_of(source));
  switch (e.at(source).type) {
    case Scalar::f32: value = e.canonical_bits(value); break;
    case Scalar::b1:
      value = b.CreateZExt(value, e.module().type(Scalar::i32, e.lanes_of(source)));
      break;
    default: break;
  }
  Value* address = batch_address(e, e.output_pointers, instruction.imm);
  b.CreateAlignedStore(e.spread(value, e.lanes()), address, llvm::Align(4));
  return nullptr;
}

constexpr std::array<std::pair<Op, EmitOp>, 4> group{{
    {Op::constant, constant},
    {Op::parameter, parameter},
    {Op::input, input},
    {Op::store, store},
}};

}  // namespace

OpGroup leaf_ops() { return group; }

}  // namespace nacre::codegen
