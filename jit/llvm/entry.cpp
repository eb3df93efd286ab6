#include "jit/llvm/entry.h"

#include <cstddef>
#include <cstdint>

#include "jit/llvm/function_emitter.h"
#include "jit/llvm/hoist.h"

namespace nacre::codegen {

using llvm::BasicBlock;
using llvm::Value;

namespace {

void emit_part(FunctionEmitter& e, const std::vector<bool>& hoisted, bool part) {
  for (std::size_t i = 0; i < hoisted.size(); ++i) {
    if (hoisted[i] == part) e.emit(static_cast<ValueId>(i));
  }
}

}  // namespace

void emit_entry(ModuleEmitter& module, llvm::Function& into) {
  FunctionEmitter e(module, module.program().entry(), into, module.lanes());
  Builder& b = e.builder();
  e.kernel_arguments = into.getArg(0);
  const auto field = [&](std::size_t offset, llvm::Type* type, const char* name) {
    return e.load_invariant(type, e.byte_offset(e.kernel_arguments, offset), name);
  };
  e.input_pointers = field(offsetof(KernelArguments, inputs), b.getPtrTy(), "inputs");
  e.output_pointers = field(offsetof(KernelArguments, outputs), b.getPtrTy(), "outputs");
  Value* count = field(offsetof(KernelArguments, count), b.getInt64Ty(), "count");
  const std::vector<bool> hoisted = hoistable(e.function());
  emit_part(e, hoisted, true);

  BasicBlock* before = b.GetInsertBlock();
  BasicBlock* batch = BasicBlock::Create(module.context(), "batch", &into);
  BasicBlock* leave = BasicBlock::Create(module.context(), "leave", &into);
  b.CreateBr(batch);
  b.SetInsertPoint(batch);
  llvm::PHINode* point = b.CreatePHI(b.getInt64Ty(), 2, "point");
  point->addIncoming(b.getInt64(0), before);
  e.first_point = point;
  emit_part(e, hoisted, false);
  Value* following = b.CreateAdd(point, b.getInt64(static_cast<std::uint64_t>(module.lanes())));
  point->addIncoming(following, b.GetInsertBlock());
  b.CreateCondBr(b.CreateICmpULT(following, count), batch, leave);
  b.SetInsertPoint(leave);
  b.CreateRetVoid();
}

}  // namespace nacre::codegen
