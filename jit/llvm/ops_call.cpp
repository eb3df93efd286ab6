#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

Value* argument(FunctionEmitter& e, ValueId id) {
  return e.builder().GetInsertBlock()->getParent()->getArg(e.at(id).imm + 1);
}

Value* give(FunctionEmitter& e, ValueId id) {
  const Instruction& instruction = e.at(id);
  e.gives.resize(e.function().results.size());
  e.gives[instruction.imm] = e.stored(instruction.operands[0], e.lanes());
  return nullptr;
}

Value* call(FunctionEmitter& e, ValueId id) {
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  llvm::Function* callee = e.module().instance(instruction.imm, lanes);
  const std::vector<bool>& uniform = e.module().uniform_arguments_of(instruction.imm);
  const std::span<const ValueId> operands = e.function().operands(instruction);
  std::vector<Value*> arguments{e.kernel_arguments};
  for (std::size_t i = 0; i < operands.size(); ++i) {
    arguments.push_back(e.stored(operands[i], uniform[i] ? 1 : lanes));
  }
  llvm::CallInst* made = e.builder().CreateCall(callee, arguments);
  made->setCallingConv(callee->getCallingConv());
  return made;
}

Value* result(FunctionEmitter& e, ValueId id) {
  const Instruction& instruction = e.at(id);
  return e.builder().CreateExtractValue(e.defined(instruction.operands[0]), instruction.imm);
}

Value* load_argument(FunctionEmitter& e, llvm::Type* type, std::size_t offset) {
  return e.load_invariant(type, e.byte_offset(e.kernel_arguments, offset));
}

/// Asks the host: the operands go through arrays, so does what comes back.
Value* texture_call(FunctionEmitter& e, ValueId id) {
  Builder& b = e.builder();
  const Instruction& instruction = e.at(id);
  const auto operands = e.function().operands(instruction);
  const int lanes = e.lanes_of(id);
  const auto count = static_cast<std::uint64_t>(lanes);
  const auto put = [&](Value* to, std::size_t offset, Value* value) {
    b.CreateAlignedStore(value, e.byte_offset(to, offset), llvm::Align(4));
  };

  Value* request = e.scratch(b.getInt8Ty(), sizeof(TextureCall), "texture.call");
  Value* slot = e.use(operands[0], lanes);
  if (lanes > 1) slot = b.CreateExtractElement(slot, std::uint64_t{0});
  put(request, offsetof(TextureCall, slot), slot);
  put(request, offsetof(TextureCall, modes), e.i32(instruction.imm));
  put(request, offsetof(TextureCall, lanes), e.i32(static_cast<std::uint32_t>(lanes)));
  constexpr std::array<std::size_t, 6> fields{
      offsetof(TextureCall, u),    offsetof(TextureCall, v),    offsetof(TextureCall, dudx),
      offsetof(TextureCall, dvdx), offsetof(TextureCall, dudy), offsetof(TextureCall, dvdy)};
  for (std::size_t k = 0; k < fields.size(); ++k) {
    Value* array = e.scratch(b.getFloatTy(), count, "texture.operand");
    put(array, 0, e.use(operands[k + 1], lanes));
    b.CreateAlignedStore(array, e.byte_offset(request, fields[k]), llvm::Align(8));
  }
  Value* limits = llvm::ConstantPointerNull::get(b.getPtrTy());
  if (operands.size() > fields.size() + 1) {
    limits = e.scratch(b.getInt32Ty(), count, "texture.operand");
    put(limits, 0, e.use(operands.back(), lanes));
  }
  b.CreateAlignedStore(limits, e.byte_offset(request, offsetof(TextureCall, max_anisotropy)),
                       llvm::Align(8));
  Value* rgba = e.scratch(b.getFloatTy(), 4 * count, "texture.rgba");
  b.CreateMemSet(rgba, b.getInt8(0), 16 * count, llvm::Align(64));
  b.CreateAlignedStore(rgba, e.byte_offset(request, offsetof(TextureCall, rgba)), llvm::Align(8));

  llvm::Type* pointer = b.getPtrTy();
  Value* callback = load_argument(e, pointer, offsetof(KernelArguments, texture_callback));
  Value* user = load_argument(e, pointer, offsetof(KernelArguments, texture_user));
  llvm::Function* here = b.GetInsertBlock()->getParent();
  auto* asks = llvm::BasicBlock::Create(e.module().context(), "texture.ask", here);
  auto* done = llvm::BasicBlock::Create(e.module().context(), "texture.done", here);
  b.CreateCondBr(b.CreateIsNotNull(callback), asks, done);
  b.SetInsertPoint(asks);
  b.CreateCall(llvm::FunctionType::get(b.getVoidTy(), {pointer, pointer}, false), callback,
               {user, request});
  b.CreateBr(done);
  b.SetInsertPoint(done);

  llvm::Type* type = e.module().type(Scalar::f32, lanes);
  Value* all = llvm::PoisonValue::get(llvm::StructType::get(type, type, type, type));
  for (unsigned c = 0; c < 4; ++c) {
    Value* channel = b.CreateAlignedLoad(type, e.byte_offset(rgba, 4 * count * c), llvm::Align(4));
    all = b.CreateInsertValue(all, e.flush(channel), c);
  }
  return all;
}

constexpr std::array<std::pair<Op, EmitOp>, 5> group{{
    {Op::argument, argument},
    {Op::give, give},
    {Op::call, call},
    {Op::result, result},
    {Op::texture_call, texture_call},
}};

}  // namespace

OpGroup call_ops() { return group; }

}  // namespace nacre::codegen
