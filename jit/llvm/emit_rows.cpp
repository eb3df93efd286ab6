// What FunctionEmitter does for an entry with rows.

#include <numeric>

#include "jit/llvm/function_emitter.h"
#include "jit/llvm/lookup.h"

namespace nacre::codegen {

using llvm::BasicBlock;
using llvm::Value;

void FunctionEmitter::compute(const std::vector<ValueId>& steps) {
  for (const ValueId step : steps) values_[step] = nullptr;
  for (const ValueId step : steps) {
    if (Value* value = emit_op(at(step).op)(*this, step)) values_[step] = to_stored(value);
  }
}

void FunctionEmitter::fill(const Rows& rows, Value* points) {
  if (rows.rows.empty()) return;
  // As of a frame of parts.
  into_->addFnAttr("probe-stack", "inline-asm");
  Builder& b = builder_;
  BasicBlock* filling = BasicBlock::Create(module_.context(), "rows", into_);
  BasicBlock* filled = BasicBlock::Create(module_.context(), "filled", into_);
  has_rows_ = b.CreateICmpUGE(points, b.getInt64(rows.least_points), "has.rows");
  b.CreateCondBr(has_rows_, filling, filled);
  b.SetInsertPoint(filling);
  const std::vector<Value*> outside = values_;
  const auto lanes = static_cast<std::uint32_t>(lanes_);
  for (const Row& row : rows.rows) {
    Value* array = scratch(b.getFloatTy(), row_room(row.count), "row");
    for (std::uint32_t first = 0; first < row.count; first += lanes) {
      std::vector<std::uint32_t> indices(lanes);
      std::iota(indices.begin(), indices.end(), first);
      values_[row.index] = llvm::ConstantDataVector::get(module_.context(), indices);
      compute(row.steps);
      const llvm::Align align(sizeof(float) * lanes);
      b.CreateAlignedStore(values_[row.value], byte_offset(array, sizeof(float) * first), align);
    }
    row_arrays_.push_back(array);
    values_ = outside;
  }
  b.CreateBr(filled);
  b.SetInsertPoint(filled);
  rows_ = &rows;
}

void FunctionEmitter::emit_group(const RowGroup& group) {
  Builder& b = builder_;
  BasicBlock* reading = BasicBlock::Create(module_.context(), "read", into_);
  BasicBlock* computing = BasicBlock::Create(module_.context(), "compute", into_);
  BasicBlock* after = BasicBlock::Create(module_.context(), "after", into_);
  Value* index = use(group.index, lanes_);
  b.CreateCondBr(has_rows_, reading, computing);

  b.SetInsertPoint(reading);
  std::vector<Value*> read;
  for (const RowGroup::Read& each : group.reads) {
    Value* at = each.shift == 0 ? index : b.CreateAdd(index, i32(each.shift, lanes_));
    read.push_back(
        look_up_in_row(*this, row_arrays_[each.row], rows_->rows[each.row].count, at, lanes_));
  }
  b.CreateBr(after);
  BasicBlock* read_last = b.GetInsertBlock();

  b.SetInsertPoint(computing);
  const std::vector<Value*> outside = values_;
  compute(group.steps);
  std::vector<Value*> computed;
  for (const RowGroup::Read& each : group.reads) computed.push_back(values_[each.value]);
  values_ = outside;
  b.CreateBr(after);
  BasicBlock* computed_last = b.GetInsertBlock();

  b.SetInsertPoint(after);
  for (std::size_t k = 0; k < group.reads.size(); ++k) {
    llvm::PHINode* phi = b.CreatePHI(read[k]->getType(), 2);
    phi->addIncoming(read[k], read_last);
    phi->addIncoming(computed[k], computed_last);
    define(group.reads[k].value, phi);
  }
}

}  // namespace nacre::codegen
