// What FunctionEmitter does for an entry with rows.

#include <map>

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
  std::map<std::uint32_t, std::vector<std::size_t>> by_count;
  for (std::size_t k = 0; k < rows.rows.size(); ++k) {
    const std::uint32_t count = rows.rows[k].count;
    row_arrays_.push_back(scratch(b.getFloatTy(), row_room(count), "row"));
    by_count[count].push_back(k);
  }
  for (const auto& [count, alike] : by_count) fill_alike(rows, alike, count);
  b.CreateBr(filled);
  b.SetInsertPoint(filled);
  rows_ = &rows;
}

/// Number by number: what fills rows are loads, which nobody does side by side, and code of all
/// lanes for each of a row's pieces took most of the time to compile an entry.
void FunctionEmitter::fill_alike(const Rows& rows, const std::vector<std::size_t>& alike,
                                 std::uint32_t count) {
  Builder& b = builder_;
  BasicBlock* before = b.GetInsertBlock();
  BasicBlock* number = BasicBlock::Create(module_.context(), "number", into_);
  BasicBlock* after = BasicBlock::Create(module_.context(), "numbers", into_);
  b.CreateBr(number);
  b.SetInsertPoint(number);
  llvm::PHINode* index = b.CreatePHI(b.getInt32Ty(), 2, "index");
  index->addIncoming(i32(0), before);
  const std::vector<Value*> outside = values_;
  const int lanes = lanes_;
  lanes_ = 1;
  for (const std::size_t k : alike) {
    const Row& row = rows.rows[k];
    values_[row.index] = index;
    compute(row.steps);
    Value* place = b.CreateInBoundsGEP(b.getFloatTy(), row_arrays_[k], index);
    b.CreateAlignedStore(values_[row.value], place, llvm::Align(sizeof(float)));
  }
  lanes_ = lanes;
  values_ = outside;
  Value* next = b.CreateAdd(index, i32(1));
  index->addIncoming(next, b.GetInsertBlock());
  b.CreateCondBr(b.CreateICmpULT(next, i32(count)), number, after);
  b.SetInsertPoint(after);
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
