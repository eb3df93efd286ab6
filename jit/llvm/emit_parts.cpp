// What FunctionEmitter does for an entry that is cut into parts.

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "jit/llvm/function_emitter.h"

namespace nacre::codegen {

void FunctionEmitter::begin_entry(llvm::Value* arguments) {
  kernel_arguments = arguments;
  const auto pointer = [&](std::size_t offset, const char* name) {
    return load_invariant(builder_.getPtrTy(), byte_offset(arguments, offset), name);
  };
  input_pointers = pointer(offsetof(KernelArguments, inputs), "inputs");
  output_pointers = pointer(offsetof(KernelArguments, outputs), "outputs");
}

void FunctionEmitter::cut(const Parts& parts) {
  if (parts.count == 0) return;
  parts_ = &parts;
  frame_ = scratch(builder_.getInt8Ty(), std::max<std::size_t>(1, parts.frame_bytes), "frame");
  // A large frame may reach beyond the page that guards a stack.
  into_->addFnAttr("probe-stack", "inline-asm");
}

void FunctionEmitter::enter_part(std::uint32_t part) {
  llvm::Type* pointer = builder_.getPtrTy();
  llvm::Type* number = builder_.getInt64Ty();
  llvm::Function* made = module_.add_function(
      fmt::format("part.{}", part),
      llvm::FunctionType::get(builder_.getVoidTy(), {pointer, pointer, number}, false));
  for (const unsigned k : {0u, 1u}) made->addParamAttr(k, llvm::Attribute::NoAlias);
  llvm::Value* first = first_point != nullptr ? first_point : builder_.getInt64(0);
  builder_.CreateCall(made, {kernel_arguments, frame_, first})
      ->setCallingConv(made->getCallingConv());
  outside_ = {.into = into_,
              .block = builder_.GetInsertBlock(),
              .lines = lines_,
              .kernel_arguments = kernel_arguments,
              .input_pointers = input_pointers,
              .output_pointers = output_pointers,
              .first_point = first_point,
              .frame = frame_};
  part_ = part;
  into_ = made;
  lines_ = module_.lines_of(function_, *made);
  builder_.SetInsertPoint(llvm::BasicBlock::Create(module_.context(), "entry", made));
  say_line(0);
  begin_entry(made->getArg(0));
  frame_ = made->getArg(1);
  first_point = made->getArg(2);
}

void FunctionEmitter::leave_part() {
  if (!outside_) return;
  builder_.CreateRetVoid();
  part_ = 0;
  into_ = outside_->into;
  lines_ = outside_->lines;
  builder_.SetInsertPoint(outside_->block);
  say_line(0);
  kernel_arguments = outside_->kernel_arguments;
  input_pointers = outside_->input_pointers;
  output_pointers = outside_->output_pointers;
  first_point = outside_->first_point;
  frame_ = outside_->frame;
  outside_.reset();
}

llvm::Value* FunctionEmitter::value_of(ValueId id) {
  if (parts_ == nullptr || parts_->home[id] == part_) {
    assert(values_[id] != nullptr);
    return values_[id];
  }
  llvm::LoadInst* load = builder_.CreateAlignedLoad(stored_type_of(id), place_of(id), align_of(id));
  // No part writes where it reads.
  if (part_ != 0) {
    load->setMetadata(llvm::LLVMContext::MD_invariant_load,
                      llvm::MDNode::get(module_.context(), {}));
  }
  return load;
}

llvm::Value* FunctionEmitter::place_of(ValueId id) {
  assert(parts_->place[id] != Parts::nowhere);
  return byte_offset(frame_, parts_->place[id]);
}

llvm::Align FunctionEmitter::align_of(ValueId id) const {
  return llvm::Align(is_wide(id) ? static_cast<std::uint64_t>(lanes_) * sizeof(float)
                                 : sizeof(float));
}

}  // namespace nacre::codegen
