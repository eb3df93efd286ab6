#include "jit/llvm/entry.h"

#include <cstddef>
#include <cstdint>

#include "jit/llvm/function_emitter.h"
#include "jit/llvm/run_state.h"
#include "runtime/program/once.h"

namespace nacre::codegen {

using llvm::BasicBlock;
using llvm::Value;

namespace {

void emit_part(FunctionEmitter& e, const std::vector<bool>& once, bool part) {
  for (std::size_t i = 0; i < once.size(); ++i) {
    if (once[i] == part) e.emit(static_cast<ValueId>(i));
  }
  e.leave_part();
}

}  // namespace

void emit_entry(ModuleEmitter& module, llvm::Function& into) {
  FunctionEmitter e(module, module.program().entry(), into, module.lanes());
  Builder& b = e.builder();
  e.begin_entry(into.getArg(0));
  const auto field = [&](std::size_t offset, llvm::Type* type, const char* name) {
    return e.load_invariant(type, e.byte_offset(e.kernel_arguments, offset), name);
  };
  Value* count = field(offsetof(KernelArguments, count), b.getInt64Ty(), "count");
  std::vector<bool> once = once_per_call(e.function());
  const Parts parts = cut_into_parts(e.function(), once, module.options());
  e.cut(parts);
  Rows rows;
  const bool has_rows =
      parts.count == 0 && module.lanes() > 1 && module.options().tier == Tier::full;
  if (has_rows) {
    rows = find_rows(e.function(), module.lanes());
    once = rows.once;
  }
  emit_part(e, once, true);
  e.fill(rows, count);

  BasicBlock* before = b.GetInsertBlock();
  BasicBlock* batch = BasicBlock::Create(module.context(), "batch", &into);
  BasicBlock* leave = BasicBlock::Create(module.context(), "leave", &into);
  b.CreateBr(batch);
  b.SetInsertPoint(batch);
  llvm::PHINode* point = b.CreatePHI(b.getInt64Ty(), 2, "point");
  point->addIncoming(b.getInt64(0), before);
  e.first_point = point;
  // A loop that takes too many steps ends, and so do those around it; so this is reached.
  const StepLimit& limit = module.limit();
  if (limit.is_counted()) {
    // Each pass has its own; what the hoisted part took too many of is not forgotten.
    Value* most = field(offsetof(RunState, max_steps), b.getInt64Ty(), "max_steps");
    Value* left = e.load_steps_left();
    e.store_steps_left(b.CreateSelect(b.CreateICmpSLT(left, b.getInt64(0)), left, most));
  }
  emit_part(e, once, false);
  Value* following = b.CreateAdd(point, b.getInt64(static_cast<std::uint64_t>(module.lanes())));
  point->addIncoming(following, b.GetInsertBlock());
  Value* goes_on = b.CreateICmpULT(following, count);
  if (limit.can_fail()) {
    goes_on = b.CreateAnd(goes_on, b.CreateICmpSGE(e.load_steps_left(), b.getInt64(0)));
  }
  if (limit.is_counted()) goes_on = b.CreateAnd(goes_on, b.CreateNot(e.load_stop()));
  b.CreateCondBr(goes_on, batch, leave);
  b.SetInsertPoint(leave);
  b.CreateRetVoid();
}

}  // namespace nacre::codegen
