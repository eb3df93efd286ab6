#include "jit/llvm/entry.h"

#include <cstddef>
#include <cstdint>

#include "jit/llvm/function_emitter.h"
#include "jit/llvm/hoist.h"

namespace nacre::codegen {

namespace {

using llvm::BasicBlock;
using llvm::Value;

class Entry {
 public:
  Entry(ModuleEmitter& module, llvm::Function& into)
      : module_(module),
        into_(into),
        e_(module, module.program().entry(), into, module.lanes()),
        b_(e_.builder()) {}

  void emit() {
    e_.kernel_arguments = into_.getArg(0);
    inputs_ = load(offsetof(KernelArguments, inputs), b_.getPtrTy(), "inputs");
    outputs_ = load(offsetof(KernelArguments, outputs), b_.getPtrTy(), "outputs");
    count_ = load(offsetof(KernelArguments, count), b_.getInt64Ty(), "count");
    const std::vector<bool> once = hoistable(e_.function());
    body(once, true);
    batches(once);
  }

 private:
  Value* load(std::size_t offset, llvm::Type* type, const char* name) {
    return e_.load_invariant(type, e_.byte_offset(e_.kernel_arguments, offset), name);
  }
  BasicBlock* block(const char* name) {
    return BasicBlock::Create(module_.context(), name, &into_);
  }

  void body(const std::vector<bool>& once, bool hoisted) {
    for (std::size_t i = 0; i < once.size(); ++i) {
      if (once[i] == hoisted) e_.emit(static_cast<ValueId>(i));
    }
  }

  void batches(const std::vector<bool>& once) {
    BasicBlock* start = b_.GetInsertBlock();
    BasicBlock* batch = block("batch");
    BasicBlock* leave = block("leave");
    b_.CreateCondBr(b_.CreateIsNotNull(count_), batch, leave);
    b_.SetInsertPoint(batch);
    llvm::PHINode* point = b_.CreatePHI(b_.getInt64Ty(), 2, "point");
    point->addIncoming(b_.getInt64(0), start);
    Value* left = b_.CreateSub(count_, point, "left");
    if (module_.lanes() == 1) {
      e_.input_pointers = inputs_;
      e_.output_pointers = outputs_;
      e_.first_point = point;
      body(once, false);
    } else {
      Value* full = b_.CreateICmpUGE(left, b_.getInt64(lanes()), "full");
      choose_memory(point, left, full);
      body(once, false);
      BasicBlock* drain = block("drain");
      BasicBlock* latch = block("latch");
      b_.CreateCondBr(full, latch, drain);
      b_.SetInsertPoint(drain);
      drain_outputs(point, left);
      b_.CreateBr(leave);
      b_.SetInsertPoint(latch);
    }
    Value* following = b_.CreateAdd(point, b_.getInt64(lanes()));
    point->addIncoming(following, b_.GetInsertBlock());
    b_.CreateCondBr(b_.CreateICmpULT(following, count_), batch, leave);
    b_.SetInsertPoint(leave);
    b_.CreateRetVoid();
  }

  /// Full batches: the host's arrays. The last: copies.
  void choose_memory(Value* point, Value* left, Value* full) {
    const Program& program = module_.program();
    const auto inputs = static_cast<std::uint64_t>(program.inputs.size());
    const auto outputs = static_cast<std::uint64_t>(program.outputs.size());
    copies_ = e_.scratch(b_.getInt32Ty(), (inputs + outputs) * lanes(), "copies");
    Value* pointers = e_.scratch(b_.getPtrTy(), inputs + outputs, "pointers");
    Value* out_pointers = e_.byte_offset(pointers, inputs * sizeof(void*));

    BasicBlock* whole = b_.GetInsertBlock();
    BasicBlock* fill = block("fill");
    BasicBlock* work = block("work");
    b_.CreateCondBr(full, work, fill);
    b_.SetInsertPoint(fill);
    b_.CreateMemSet(copies_, b_.getInt8(0), inputs * lanes() * 4, llvm::Align(64));
    repeat(b_.getInt64(inputs + outputs), [&](Value* channel) {
      b_.CreateStore(copy_of(channel), b_.CreateInBoundsGEP(b_.getPtrTy(), pointers, channel));
    });
    repeat(b_.getInt64(inputs), [&](Value* channel) {
      copy(copy_of(channel), host_array(inputs_, channel, point), left);
    });
    BasicBlock* filled = b_.GetInsertBlock();
    b_.CreateBr(work);
    b_.SetInsertPoint(work);
    const auto choose = [&](Value* host, Value* copied, const char* name) {
      llvm::PHINode* phi = b_.CreatePHI(host->getType(), 2, name);
      phi->addIncoming(host, whole);
      phi->addIncoming(copied, filled);
      return phi;
    };
    e_.input_pointers = choose(inputs_, pointers, "in");
    e_.output_pointers = choose(outputs_, out_pointers, "out");
    e_.first_point = choose(point, b_.getInt64(0), "first");
  }

  void drain_outputs(Value* point, Value* left) {
    const std::uint64_t inputs = module_.program().inputs.size();
    repeat(b_.getInt64(module_.program().outputs.size()), [&](Value* channel) {
      Value* copied = copy_of(b_.CreateAdd(channel, b_.getInt64(inputs)));
      copy(host_array(outputs_, channel, point), copied, left);
    });
  }

  Value* copy_of(Value* channel) {
    return b_.CreateInBoundsGEP(b_.getInt32Ty(), copies_,
                                b_.CreateMul(channel, b_.getInt64(lanes())));
  }
  Value* host_array(Value* arrays, Value* channel, Value* point) {
    Value* array = b_.CreateAlignedLoad(
        b_.getPtrTy(), b_.CreateInBoundsGEP(b_.getPtrTy(), arrays, channel), llvm::Align(8));
    return b_.CreateInBoundsGEP(b_.getInt32Ty(), array, point);
  }
  void copy(Value* to, Value* from, Value* words) {
    repeat(words, [&](Value* k) {
      llvm::Type* word = b_.getInt32Ty();
      Value* value = b_.CreateLoad(word, b_.CreateInBoundsGEP(word, from, k));
      b_.CreateStore(value, b_.CreateInBoundsGEP(word, to, k));
    });
  }

  /// A plain loop: each(k) for k = 0 ... count - 1.
  template <class F>
  void repeat(Value* count, F&& each) {
    BasicBlock* before = b_.GetInsertBlock();
    BasicBlock* head = block("head");
    BasicBlock* inside = block("inside");
    BasicBlock* after = block("after");
    b_.CreateBr(head);
    b_.SetInsertPoint(head);
    llvm::PHINode* k = b_.CreatePHI(b_.getInt64Ty(), 2, "k");
    k->addIncoming(b_.getInt64(0), before);
    b_.CreateCondBr(b_.CreateICmpULT(k, count), inside, after);
    b_.SetInsertPoint(inside);
    each(k);
    k->addIncoming(b_.CreateAdd(k, b_.getInt64(1)), b_.GetInsertBlock());
    b_.CreateBr(head);
    b_.SetInsertPoint(after);
  }

  std::uint64_t lanes() const { return static_cast<std::uint64_t>(e_.lanes()); }

  ModuleEmitter& module_;
  llvm::Function& into_;
  FunctionEmitter e_;
  Builder& b_;
  Value* inputs_ = nullptr;
  Value* outputs_ = nullptr;
  Value* count_ = nullptr;
  Value* copies_ = nullptr;
};

}  // namespace

void emit_entry(ModuleEmitter& module, llvm::Function& into) { Entry(module, into).emit(); }

}  // namespace nacre::codegen
