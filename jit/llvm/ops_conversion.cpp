#include <array>

#include "jit/llvm/ops.h"
#include "jit/llvm/truncate.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

Value* only_operand(FunctionEmitter& e, ValueId id) {
  return e.operand(e.at(id), 0, e.lanes_of(id));
}

Value* float_to_int(FunctionEmitter& e, ValueId id) {
  return truncate_saturated(e, only_operand(e, id), e.lanes_of(id));
}

Value* int_to_float(FunctionEmitter& e, ValueId id) {
  return e.builder().CreateSIToFP(only_operand(e, id), e.type_of(id));
}

Value* unsigned_to_float(FunctionEmitter& e, ValueId id) {
  return e.builder().CreateUIToFP(only_operand(e, id), e.type_of(id));
}

Value* bits(FunctionEmitter& e, ValueId id) { return e.canonical_bits(only_operand(e, id)); }

Value* from_bits(FunctionEmitter& e, ValueId id) {
  return e.flush(e.builder().CreateBitCast(only_operand(e, id), e.type_of(id)));
}

Value* bool_to_int(FunctionEmitter& e, ValueId id) {
  return e.builder().CreateZExt(only_operand(e, id), e.type_of(id));
}

/// Without F16C: magnitude * 2^-24 where the half is denormal, else exponent and
/// mantissa moved into place and the exponent's bias (127 against 15) corrected.
Value* half_by_integers(FunctionEmitter& e, Value* word, int lanes) {
  Builder& b = e.builder();
  const auto n = [&](std::uint32_t value) { return e.i32(value, lanes); };
  llvm::Type* floats = e.module().type(Scalar::f32, lanes);
  llvm::Type* words = e.module().type(Scalar::i32, lanes);
  Value* sign = b.CreateShl(b.CreateAnd(word, n(0x8000)), n(16));
  Value* magnitude = b.CreateAnd(word, n(0x7fff));
  Value* small =
      b.CreateFMul(b.CreateSIToFP(magnitude, floats), llvm::ConstantFP::get(floats, 0x1p-24));
  Value* moved = b.CreateShl(magnitude, n(13));
  Value* normal = b.CreateAdd(moved, n(112u << 23));
  Value* special = b.CreateAdd(moved, n(224u << 23));
  Value* result =
      b.CreateSelect(b.CreateICmpULT(magnitude, n(0x0400)), b.CreateBitCast(small, words), normal);
  result = b.CreateSelect(b.CreateICmpULT(magnitude, n(0x7c00)), result, special);
  return b.CreateBitCast(b.CreateOr(result, sign), floats);
}

Value* half_to_float(FunctionEmitter& e, ValueId id) {
  Builder& b = e.builder();
  const int lanes = e.lanes_of(id);
  Value* word = only_operand(e, id);
  if (!e.module().features().f16c) return half_by_integers(e, word, lanes);
  const auto vector_of = [&](llvm::Type* element) -> llvm::Type* {
    if (lanes == 1) return element;
    return llvm::FixedVectorType::get(element, static_cast<unsigned>(lanes));
  };
  Value* low = b.CreateTrunc(word, vector_of(b.getInt16Ty()));
  return b.CreateFPExt(b.CreateBitCast(low, vector_of(b.getHalfTy())), e.type_of(id));
}

constexpr std::array<std::pair<Op, EmitOp>, 7> group{{
    {Op::f_to_i, float_to_int},
    {Op::i_to_f, int_to_float},
    {Op::u_to_f, unsigned_to_float},
    {Op::bits, bits},
    {Op::from_bits, from_bits},
    {Op::b_to_i, bool_to_int},
    {Op::half_to_f, half_to_float},
}};

}  // namespace

OpGroup conversion_ops() { return group; }

}  // namespace nacre::codegen
