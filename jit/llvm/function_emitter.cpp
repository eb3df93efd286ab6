#include "jit/llvm/function_emitter.h"

#include <cassert>
#include <cstddef>

#include "jit/llvm/run_state.h"
#include "jit/llvm/word_run.h"
#include "runtime/program/fold.h"

namespace nacre::codegen {

FunctionEmitter::FunctionEmitter(ModuleEmitter& module, const Function& function,
                                 llvm::Function& into, int lanes)
    : module_(module),
      function_(function),
      into_(&into),
      lanes_(lanes),
      lines_(module.lines_of(function, into)),
      builder_(llvm::BasicBlock::Create(into.getContext(), "entry", &into)),
      values_(function.code.size(), nullptr) {
  say_line(0);
}

void FunctionEmitter::emit(ValueId id) {
  const EmitOp op = emit_op(at(id).op);
  assert(op != nullptr && "a pass should have expanded this operation");
  const bool has_home = parts_ != nullptr && at(id).op != Op::constant;
  if (has_home && parts_->home[id] != part_) {
    leave_part();
    if (parts_->home[id] != 0) enter_part(parts_->home[id]);
  }
  say_line(id + 1);
  if (rows_ != nullptr && rows_->is_in_group[id]) {
    const auto group = rows_->groups.find(id);
    if (group != rows_->groups.end()) emit_group(group->second);
    return;
  }
  if (llvm::Value* value = op(*this, id)) define(id, to_stored(value));
  // Not before: several phis stand together.
  for (const ValueId made : to_store_) {
    builder_.CreateAlignedStore(values_[made], place_of(made), align_of(made));
  }
  to_store_.clear();
}

void FunctionEmitter::say_line(std::uint32_t line) {
  if (lines_ == nullptr) return;
  builder_.SetCurrentDebugLocation(llvm::DILocation::get(module_.context(), line, 0, lines_));
}

void FunctionEmitter::define(ValueId id, llvm::Value* value) {
  values_[id] = value;
  if (parts_ != nullptr && parts_->place[id] != Parts::nowhere) to_store_.push_back(id);
}

std::vector<ValueId> FunctionEmitter::word_run(ValueId first) const {
  return codegen::word_run(function_, first, [&](ValueId id) {
    return parts_ == nullptr || parts_->same_home(first, id);
  });
}

llvm::Value* FunctionEmitter::use(ValueId id, int lanes) {
  const Instruction& instruction = at(id);
  if (instruction.op == Op::constant) {
    switch (instruction.type) {
      case Scalar::f32: return f32_bits(flush_denormal(instruction.imm), lanes);
      case Scalar::i32: return i32(instruction.imm, lanes);
      default:
        return llvm::ConstantInt::getBool(module_.type(Scalar::b1, lanes), instruction.imm != 0);
    }
  }
  return from_stored(spread(value_of(id), lanes), instruction.type);
}

llvm::Value* FunctionEmitter::stored(ValueId id, int lanes) {
  if (at(id).op == Op::constant) return to_stored(use(id, lanes));
  return to_stored(spread(value_of(id), lanes));
}

llvm::Value* FunctionEmitter::to_stored(llvm::Value* value) {
  const auto* vector = llvm::dyn_cast<llvm::FixedVectorType>(value->getType());
  if (vector == nullptr || !vector->getElementType()->isIntegerTy(1)) return value;
  llvm::Type* type = module_.stored_type(Scalar::b1, static_cast<int>(vector->getNumElements()));
  return type == value->getType() ? value : builder_.CreateSExt(value, type);
}

llvm::Value* FunctionEmitter::from_stored(llvm::Value* value, Scalar scalar) {
  if (scalar != Scalar::b1 || value->getType()->getScalarType()->isIntegerTy(1)) return value;
  return builder_.CreateICmpSLT(value, llvm::Constant::getNullValue(value->getType()));
}

llvm::Value* FunctionEmitter::spread(llvm::Value* value, int lanes) {
  if (lanes == 1 || value->getType()->isVectorTy()) return value;
  const auto count = llvm::ElementCount::getFixed(static_cast<unsigned>(lanes));
  if (auto* constant = llvm::dyn_cast<llvm::Constant>(value)) {
    return llvm::ConstantVector::getSplat(count, constant);
  }
  return builder_.CreateVectorSplat(count, value);
}

llvm::Value* FunctionEmitter::any(llvm::Value* mask) {
  auto* vector = llvm::dyn_cast<llvm::FixedVectorType>(mask->getType());
  if (vector == nullptr) return mask;
  llvm::Type* word = builder_.getIntNTy(vector->getNumElements());
  return builder_.CreateICmpNE(builder_.CreateBitCast(mask, word), llvm::ConstantInt::get(word, 0));
}

llvm::Constant* FunctionEmitter::i32(std::uint32_t value, int lanes) {
  return llvm::ConstantInt::get(module_.type(Scalar::i32, lanes), value);
}

llvm::Constant* FunctionEmitter::f32_bits(std::uint32_t bits, int lanes) {
  const llvm::APFloat value(llvm::APFloat::IEEEsingle(), llvm::APInt(32, bits));
  return llvm::ConstantFP::get(module_.type(Scalar::f32, lanes), value);
}

llvm::AllocaInst* FunctionEmitter::scratch(llvm::Type* type, std::uint64_t count,
                                           const char* name) {
  llvm::BasicBlock& first = into_->getEntryBlock();
  Builder at_start(&first, first.getFirstInsertionPt());
  llvm::AllocaInst* slot =
      at_start.CreateAlloca(type, at_start.getInt32(static_cast<unsigned>(count)), name);
  slot->setAlignment(llvm::Align(64));
  return slot;
}

llvm::LoadInst* FunctionEmitter::load_invariant(llvm::Type* type, llvm::Value* from,
                                                const char* name) {
  const llvm::Align align(type->isPointerTy() || type->isIntegerTy(64) ? 8 : 4);
  llvm::LoadInst* load = builder_.CreateAlignedLoad(type, from, align, name);
  load->setMetadata(llvm::LLVMContext::MD_invariant_load,
                    llvm::MDNode::get(type->getContext(), {}));
  return load;
}

llvm::Value* FunctionEmitter::byte_offset(llvm::Value* base, std::size_t bytes) {
  if (bytes == 0) return base;
  return builder_.CreateConstInBoundsGEP1_64(builder_.getInt8Ty(), base, bytes);
}

llvm::Value* FunctionEmitter::load_steps_left() {
  llvm::Value* from = byte_offset(kernel_arguments, offsetof(RunState, steps_left));
  return builder_.CreateAlignedLoad(builder_.getInt64Ty(), from, llvm::Align(8), "steps");
}

void FunctionEmitter::store_steps_left(llvm::Value* value) {
  llvm::Value* to = byte_offset(kernel_arguments, offsetof(RunState, steps_left));
  builder_.CreateAlignedStore(value, to, llvm::Align(8));
}

llvm::Value* FunctionEmitter::load_stop() {
  llvm::Value* flag = load_invariant(
      builder_.getPtrTy(), byte_offset(kernel_arguments, offsetof(KernelArguments, stop)), "stop");
  llvm::LoadInst* load =
      builder_.CreateAlignedLoad(builder_.getInt32Ty(), flag, llvm::Align(4), "stop.value");
  load->setAtomic(llvm::AtomicOrdering::Monotonic);
  return builder_.CreateICmpNE(load, i32(0));
}

llvm::Value* FunctionEmitter::flush(llvm::Value* x) {
  llvm::Value* one = load_invariant(builder_.getFloatTy(), module_.opaque_one(), "one");
  const auto* vector = llvm::dyn_cast<llvm::FixedVectorType>(x->getType());
  return builder_.CreateFMul(
      x, spread(one, vector != nullptr ? static_cast<int>(vector->getNumElements()) : 1));
}

llvm::Value* FunctionEmitter::canonical_bits(llvm::Value* x) {
  const auto* vector = llvm::dyn_cast<llvm::FixedVectorType>(x->getType());
  const int lanes = vector != nullptr ? static_cast<int>(vector->getNumElements()) : 1;
  llvm::Value* bits = builder_.CreateBitCast(x, module_.type(Scalar::i32, lanes));
  return builder_.CreateSelect(builder_.CreateFCmpUNO(x, x), i32(canonical_nan, lanes), bits);
}

}  // namespace nacre::codegen
