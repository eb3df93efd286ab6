#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "jit/llvm/gather.h"
#include "jit/llvm/lanes.h"
#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

/// A texture's first word, and the number of the last that 32 bits reach.
struct Binding {
  Value* words;
  Value* last;

  Words all() const { return {Scalar::i32, words, true}; }
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
  // A texture of no words still has word 0: see TextureBinding.
  Value* from_one = b.CreateBinaryIntrinsic(llvm::Intrinsic::umax, count, b.getInt64(1));
  Value* last = b.CreateBinaryIntrinsic(llvm::Intrinsic::umin, b.CreateSub(from_one, b.getInt64(1)),
                                        b.getInt64(~0u));
  return {words, b.CreateTrunc(last, b.getInt32Ty())};
}

/// One word for each lane; beyond the end, word 0.
Value* load_words(FunctionEmitter& e, Binding from, Value* word, int lanes) {
  Builder& b = e.builder();
  Value* inside = b.CreateICmpULE(word, e.spread(from.last, lanes));
  return gather(e, from.all(), b.CreateSelect(inside, word, e.i32(0, lanes)), lanes);
}

/// `count` neighbouring words for each lane where some lane reaches beyond the end, word
/// by word: a function of its own, because that happens hardly ever.
llvm::Function* slow_runs(FunctionEmitter& e, int lanes, std::size_t count) {
  ModuleEmitter& module = e.module();
  const std::string name = "texel.run" + std::to_string(count) + ".w" + std::to_string(lanes);
  if (llvm::Function* known = module.module().getFunction(name)) return known;
  llvm::Type* vector = module.type(Scalar::i32, lanes);
  auto* result = llvm::StructType::get(module.context(), std::vector<llvm::Type*>(count, vector));
  llvm::Function* made = module.add_function(
      name, llvm::FunctionType::get(
                result, {e.builder().getPtrTy(), e.builder().getInt32Ty(), vector}, false));
  made->addFnAttr(llvm::Attribute::Cold);
  const Function empty;
  FunctionEmitter inside(module, empty, *made, lanes);
  Builder& b = inside.builder();
  llvm::Type* word_type = b.getInt32Ty();
  const auto width = static_cast<std::uint64_t>(lanes);
  Value* first = inside.scratch(word_type, width, "first");
  Value* loaded = inside.scratch(word_type, width * count, "loaded");
  const auto element = [&](Value* array, Value* k) {
    return b.CreateInBoundsGEP(word_type, array, k);
  };
  b.CreateAlignedStore(made->getArg(2), first, llvm::Align(64));

  llvm::BasicBlock* before = b.GetInsertBlock();
  auto* each = llvm::BasicBlock::Create(module.context(), "each", made);
  auto* done = llvm::BasicBlock::Create(module.context(), "done", made);
  b.CreateBr(each);
  b.SetInsertPoint(each);
  llvm::PHINode* k = b.CreatePHI(b.getInt64Ty(), 2, "lane");
  k->addIncoming(b.getInt64(0), before);
  Value* own = b.CreateLoad(word_type, element(first, k));
  for (std::uint32_t w = 0; w < count; ++w) {
    Value* word = b.CreateAdd(own, inside.i32(w));
    Value* value = load_words(inside, {made->getArg(0), made->getArg(1)}, word, 1);
    b.CreateStore(value, element(loaded, b.CreateAdd(k, b.getInt64(w * width))));
  }
  Value* next = b.CreateAdd(k, b.getInt64(1));
  k->addIncoming(next, each);
  b.CreateCondBr(b.CreateICmpULT(next, b.getInt64(width)), each, done);
  b.SetInsertPoint(done);
  Value* all = llvm::PoisonValue::get(result);
  for (unsigned w = 0; w < count; ++w) {
    Value* words =
        b.CreateAlignedLoad(vector, inside.byte_offset(loaded, 4 * width * w), llvm::Align(4));
    all = b.CreateInsertValue(all, words, w);
  }
  b.CreateRet(all);
  return made;
}

/// Defines every texel of a run; leaves the builder behind both ways.
void emit_run(FunctionEmitter& e, const std::vector<ValueId>& run, Binding from, Value* first,
              int lanes) {
  Builder& b = e.builder();
  const auto further = static_cast<std::uint32_t>(run.size() - 1);
  Value* long_enough = b.CreateICmpUGE(from.last, e.i32(further));
  Value* limit = b.CreateSub(from.last, e.i32(further));
  Value* beyond = e.any(b.CreateICmpUGT(first, e.spread(limit, lanes)));
  Value* safe = b.CreateAnd(long_enough, b.CreateNot(beyond));

  llvm::Function* here = b.GetInsertBlock()->getParent();
  const auto block = [&](const char* name) {
    return llvm::BasicBlock::Create(here->getContext(), name, here);
  };
  llvm::BasicBlock* fast = block("texel.fast");
  llvm::BasicBlock* slow = block("texel.slow");
  llvm::BasicBlock* done = block("texel.done");
  b.CreateCondBr(safe, fast, slow, llvm::MDBuilder(here->getContext()).createLikelyBranchWeights());
  b.SetInsertPoint(fast);
  const std::vector<Value*> loaded = gather_run(e, from.all(), first, lanes, run.size());
  b.CreateBr(done);
  b.SetInsertPoint(slow);
  llvm::CallInst* call =
      b.CreateCall(slow_runs(e, lanes, run.size()), {from.words, from.last, first});
  call->setCallingConv(llvm::CallingConv::Fast);
  std::vector<Value*> computed;
  for (unsigned w = 0; w < run.size(); ++w) computed.push_back(b.CreateExtractValue(call, w));
  b.CreateBr(done);
  b.SetInsertPoint(done);
  for (std::size_t w = 0; w < run.size(); ++w) {
    if (run[w] == no_value) continue;
    llvm::PHINode* phi = b.CreatePHI(loaded[w]->getType(), 2);
    phi->addIncoming(loaded[w], fast);
    phi->addIncoming(computed[w], slow);
    e.define(run[w], phi);
  }
}

Value* texel(FunctionEmitter& e, ValueId id) {
  if (e.defined(id) != nullptr) return nullptr;  // By a run.
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  const ValueId slot_id = instruction.operands[0];
  Value* word = e.operand(instruction, 1, lanes);
  if (!e.is_wide(slot_id) || e.at(slot_id).op == Op::constant) {
    const Binding binding = load_binding(e, e.use(slot_id, 1));
    const std::vector<ValueId> run = e.word_run(id);
    if (lanes == 1 || run.size() == 1) return load_words(e, binding, word, lanes);
    emit_run(e, run, binding, word, lanes);
    return nullptr;
  }
  Value* slot = e.use(slot_id, lanes);
  return each_lane(e, Scalar::i32, lanes, [&](int k) {
    return load_words(e, load_binding(e, lane(e, slot, k)), lane(e, word, k), 1);
  });
}

constexpr std::array<std::pair<Op, EmitOp>, 1> group{{{Op::texel, texel}}};

}  // namespace

OpGroup texel_ops() { return group; }

}  // namespace nacre::codegen
