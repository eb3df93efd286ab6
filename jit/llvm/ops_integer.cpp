#include <array>

#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

Value* operand(FunctionEmitter& e, ValueId id, std::size_t k) {
  return e.operand(e.at(id), k, e.lanes_of(id));
}

template <llvm::Instruction::BinaryOps op>
Value* binary(FunctionEmitter& e, ValueId id) {
  return e.builder().CreateBinOp(op, operand(e, id, 0), operand(e, id, 1));
}

template <llvm::Instruction::BinaryOps op>
Value* shift(FunctionEmitter& e, ValueId id) {
  Value* count = e.builder().CreateAnd(operand(e, id, 1), e.i32(31, e.lanes_of(id)));
  return e.builder().CreateBinOp(op, operand(e, id, 0), count);
}

Value* high_product(FunctionEmitter& e, ValueId id) {
  Builder& b = e.builder();
  llvm::Type* narrow = e.type_of(id);
  llvm::Type* wide = narrow->getExtendedType();
  Value* product =
      b.CreateMul(b.CreateZExt(operand(e, id, 0), wide), b.CreateZExt(operand(e, id, 1), wide));
  return b.CreateTrunc(b.CreateLShr(product, llvm::ConstantInt::get(wide, 32)), narrow);
}

template <llvm::CmpInst::Predicate predicate>
Value* compare(FunctionEmitter& e, ValueId id) {
  return e.builder().CreateICmp(predicate, operand(e, id, 0), operand(e, id, 1));
}

/// On masks in the form they are kept in.
template <llvm::Instruction::BinaryOps op>
Value* logic(FunctionEmitter& e, ValueId id) {
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  return e.builder().CreateBinOp(op, e.stored(instruction.operands[0], lanes),
                                 e.stored(instruction.operands[1], lanes));
}

Value* complement(FunctionEmitter& e, ValueId id) {
  return e.builder().CreateXor(e.stored(e.at(id).operands[0], e.lanes_of(id)),
                               llvm::Constant::getAllOnesValue(e.stored_type_of(id)));
}

/// A sign that a mask flips, on bits: AVX-512 then needs one masked xor, where LLVM makes
/// a negation and a blend of floats. `flipped` is the side that is negated.
Value* select_sign(FunctionEmitter& e, ValueId id, std::size_t flipped) {
  Builder& b = e.builder();
  const int lanes = e.lanes_of(id);
  Value* plain = b.CreateBitCast(operand(e, id, 3 - flipped), e.module().type(Scalar::i32, lanes));
  Value* negated = b.CreateXor(plain, e.i32(0x80000000u, lanes));
  Value* mask = e.use(e.at(id).operands[0], lanes);
  Value* chosen =
      flipped == 1 ? b.CreateSelect(mask, negated, plain) : b.CreateSelect(mask, plain, negated);
  return b.CreateBitCast(chosen, e.type_of(id));
}

Value* select(FunctionEmitter& e, ValueId id) {
  for (const std::size_t side : {1, 2}) {
    const Instruction& negated = e.at(e.at(id).operands[side]);
    const bool is_neg = negated.op == Op::neg && negated.operands[0] == e.at(id).operands[3 - side];
    if (is_neg && e.is_wide(id)) return select_sign(e, id, side);
  }
  return e.builder().CreateSelect(e.use(e.at(id).operands[0], e.lanes_of(id)), operand(e, id, 1),
                                  operand(e, id, 2));
}

constexpr std::array<std::pair<Op, EmitOp>, 18> group{{
    {Op::iadd, binary<llvm::Instruction::Add>},
    {Op::isub, binary<llvm::Instruction::Sub>},
    {Op::imul, binary<llvm::Instruction::Mul>},
    {Op::umulhi, high_product},
    {Op::iand, binary<llvm::Instruction::And>},
    {Op::ior, binary<llvm::Instruction::Or>},
    {Op::ixor, binary<llvm::Instruction::Xor>},
    {Op::shl, shift<llvm::Instruction::Shl>},
    {Op::lshr, shift<llvm::Instruction::LShr>},
    {Op::ashr, shift<llvm::Instruction::AShr>},
    {Op::ieq, compare<llvm::CmpInst::ICMP_EQ>},
    {Op::ilt, compare<llvm::CmpInst::ICMP_SLT>},
    {Op::ult, compare<llvm::CmpInst::ICMP_ULT>},
    {Op::band, logic<llvm::Instruction::And>},
    {Op::bor, logic<llvm::Instruction::Or>},
    {Op::bxor, logic<llvm::Instruction::Xor>},
    {Op::bnot, complement},
    {Op::select, select},
}};

}  // namespace

OpGroup integer_ops() { return group; }

}  // namespace nacre::codegen
