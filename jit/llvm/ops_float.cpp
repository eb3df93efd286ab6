#include <array>

#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

using llvm::Value;
using Intrinsic = llvm::Intrinsic::ID;

/// Sets what `fast` allows for the operations built in its life.
class FastScope {
 public:
  explicit FastScope(FunctionEmitter& e) : guard_(e.builder()) {
    if (!e.module().is_fast()) return;
    llvm::FastMathFlags flags;
    flags.setAllowReassoc();
    flags.setNoSignedZeros();
    flags.setAllowReciprocal();
    flags.setAllowContract(true);
    e.builder().setFastMathFlags(flags);
  }

 private:
  llvm::IRBuilderBase::FastMathFlagGuard guard_;
};

Value* operand(FunctionEmitter& e, ValueId id, std::size_t k) {
  return e.operand(e.at(id), k, e.lanes_of(id));
}

template <llvm::Instruction::BinaryOps op>
Value* binary(FunctionEmitter& e, ValueId id) {
  const FastScope scope(e);
  return e.builder().CreateBinOp(op, operand(e, id, 0), operand(e, id, 1));
}

template <Intrinsic intrinsic>
Value* unary_intrinsic(FunctionEmitter& e, ValueId id) {
  return e.builder().CreateUnaryIntrinsic(intrinsic, operand(e, id, 0));
}

Value* sqrt(FunctionEmitter& e, ValueId id) {
  const FastScope scope(e);
  return e.builder().CreateUnaryIntrinsic(llvm::Intrinsic::sqrt, operand(e, id, 0));
}

Value* fma(FunctionEmitter& e, ValueId id) {
  const FastScope scope(e);
  return e.builder().CreateIntrinsic(llvm::Intrinsic::fma, {e.type_of(id)},
                                     {operand(e, id, 0), operand(e, id, 1), operand(e, id, 2)});
}

Value* negate(FunctionEmitter& e, ValueId id) { return e.builder().CreateFNeg(operand(e, id, 0)); }

/// a ? b : b' for a comparison of the operands: one minps or maxps, whose second
/// operand too is the result where either is NaN.
template <llvm::CmpInst::Predicate predicate>
Value* extremum(FunctionEmitter& e, ValueId id) {
  Value* a = operand(e, id, 0);
  Value* b = operand(e, id, 1);
  return e.builder().CreateSelect(e.builder().CreateFCmp(predicate, a, b), a, b);
}

template <llvm::CmpInst::Predicate predicate>
Value* compare(FunctionEmitter& e, ValueId id) {
  return e.builder().CreateFCmp(predicate, operand(e, id, 0), operand(e, id, 1));
}

constexpr std::array<std::pair<Op, EmitOp>, 18> group{{
    {Op::add, binary<llvm::Instruction::FAdd>},
    {Op::sub, binary<llvm::Instruction::FSub>},
    {Op::mul, binary<llvm::Instruction::FMul>},
    {Op::div, binary<llvm::Instruction::FDiv>},
    {Op::fma, fma},
    {Op::min, extremum<llvm::CmpInst::FCMP_OLT>},
    {Op::max, extremum<llvm::CmpInst::FCMP_OGT>},
    {Op::sqrt, sqrt},
    {Op::neg, negate},
    {Op::abs, unary_intrinsic<llvm::Intrinsic::fabs>},
    {Op::floor, unary_intrinsic<llvm::Intrinsic::floor>},
    {Op::ceil, unary_intrinsic<llvm::Intrinsic::ceil>},
    {Op::trunc, unary_intrinsic<llvm::Intrinsic::trunc>},
    {Op::round, unary_intrinsic<llvm::Intrinsic::roundeven>},
    {Op::eq, compare<llvm::CmpInst::FCMP_OEQ>},
    {Op::ne, compare<llvm::CmpInst::FCMP_UNE>},
    {Op::lt, compare<llvm::CmpInst::FCMP_OLT>},
    {Op::le, compare<llvm::CmpInst::FCMP_OLE>},
}};

}  // namespace

OpGroup float_ops() { return group; }

}  // namespace nacre::codegen
