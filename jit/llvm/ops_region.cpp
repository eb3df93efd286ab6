#include <array>
#include <cassert>

#include "jit/llvm/ops.h"

namespace nacre::codegen {

namespace {

using llvm::BasicBlock;
using llvm::Value;

BasicBlock* new_block(FunctionEmitter& e, const char* name) {
  return BasicBlock::Create(e.module().context(), name, e.builder().GetInsertBlock()->getParent());
}

/// stored(id), emitted where the region has not begun.
Value* stored_before(FunctionEmitter& e, const Region& region, ValueId id, int lanes) {
  const llvm::IRBuilderBase::InsertPointGuard guard(e.builder());
  e.builder().SetInsertPoint(region.before->getTerminator());
  return e.stored(id, lanes);
}

bool is_true(Value* mask) {
  const auto* constant = llvm::dyn_cast<llvm::Constant>(mask);
  return constant != nullptr && constant->isAllOnesValue();
}

/// Starts a region: `before` gets its branch, the builder stands in the region.
Region open(FunctionEmitter& e, ValueId id, const char* name) {
  const ValueId mask_id = e.at(id).operands[0];
  // A loop that becomes varying by its `again` needs a mask for each lane.
  Value* mask = e.use(mask_id, e.lanes_of(id));
  Region region{.open = id,
                .before = e.builder().GetInsertBlock(),
                .after = new_block(e, "after"),
                .always = is_true(mask),
                .merges = {},
                .carries = {}};
  BasicBlock* body = new_block(e, name);
  if (region.always) {
    e.builder().CreateBr(body);
  } else {
    e.builder().CreateCondBr(e.any(mask), body, region.after);
  }
  e.builder().SetInsertPoint(body);
  return region;
}

Value* if_any(FunctionEmitter& e, ValueId id) {
  e.regions.push_back(open(e, id, "if"));
  return nullptr;
}

Value* merge(FunctionEmitter& e, ValueId id) {
  Region& region = e.regions.back();
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  const ValueId outer = instruction.operands[1];
  Value* skipped = nullptr;
  for (const Merge& earlier : region.merges) {
    if (earlier.id == outer) skipped = e.spread(earlier.skipped, lanes);
  }
  if (skipped == nullptr) skipped = stored_before(e, region, outer, lanes);
  region.merges.push_back({id, skipped});
  Value* inner = e.use(instruction.operands[0], lanes);
  if (!e.is_wide(region.open)) return inner;  // All lanes run it, or none.
  Value* mask = e.operand(e.at(region.open), 0, lanes);
  return e.builder().CreateSelect(mask, inner, e.use(outer, lanes));
}

Value* end_if(FunctionEmitter& e, ValueId) {
  const Region region = std::move(e.regions.back());
  e.regions.pop_back();
  BasicBlock* last = e.builder().GetInsertBlock();
  std::vector<Value*> merged;
  for (const Merge& merge : region.merges) {
    merged.push_back(e.stored(merge.id, e.lanes_of(merge.id)));
  }
  e.builder().CreateBr(region.after);
  e.builder().SetInsertPoint(region.after);
  if (region.always) return nullptr;
  for (std::size_t k = 0; k < merged.size(); ++k) {
    const Merge& merge = region.merges[k];
    llvm::PHINode* phi = e.builder().CreatePHI(e.stored_type_of(merge.id), 2);
    phi->addIncoming(merged[k], last);
    phi->addIncoming(merge.skipped, region.before);
    e.define(merge.id, phi);
  }
  return nullptr;
}

Value* loop(FunctionEmitter& e, ValueId id) {
  assert(e.at(id).imm > 0);
  Region region = open(e, id, "loop");
  region.header = e.builder().GetInsertBlock();
  region.iteration = e.builder().CreatePHI(e.builder().getInt32Ty(), 2, "iteration");
  region.iteration->addIncoming(e.i32(0), region.before);
  if (e.is_wide(id)) {
    region.active =
        e.builder().CreatePHI(e.module().stored_type(Scalar::b1, e.lanes()), 2, "active");
    region.active->addIncoming(stored_before(e, region, e.at(id).operands[0], e.lanes()),
                               region.before);
  }
  e.regions.push_back(std::move(region));
  return nullptr;
}

Value* carry(FunctionEmitter& e, ValueId id) {
  Region& region = e.regions.back();
  Value* initial = stored_before(e, region, e.at(id).operands[0], e.lanes_of(id));
  auto* phi = llvm::PHINode::Create(e.stored_type_of(id), 2, "", region.header->getFirstNonPHIIt());
  phi->addIncoming(initial, region.before);
  region.carries.push_back({.id = id, .phi = phi, .initial = initial});
  return phi;
}

Value* next(FunctionEmitter& e, ValueId id) {
  Region& region = e.regions.back();
  const auto [carry, value] = std::pair(e.at(id).operands[0], e.at(id).operands[1]);
  for (Carry& known : region.carries) {
    if (known.id == carry) known.next = id;
  }
  const int lanes = e.lanes_of(id);
  if (region.active == nullptr) return e.use(value, lanes);
  return e.builder().CreateSelect(e.from_stored(region.active, Scalar::b1), e.use(value, lanes),
                                  e.use(carry, lanes));
}

Value* again(FunctionEmitter& e, ValueId id) {
  Region& region = e.regions.back();
  const ValueId condition = e.at(id).operands[0];
  if (region.active == nullptr) {
    region.again = e.use(condition, 1);
  } else {
    region.again = e.builder().CreateAnd(region.active, e.stored(condition, e.lanes()), "active");
  }
  return nullptr;
}

/// Takes a round's steps off what is left; whether there were enough, and nobody asks to
/// stop. Once there were not, the loops around end at their next round too.
Value* count_round(FunctionEmitter& e, ValueId open) {
  Builder& b = e.builder();
  const auto steps = static_cast<std::uint64_t>(e.module().steps_of_round(e.function(), open));
  Value* left = b.CreateSub(e.load_steps_left(), b.getInt64(steps));
  e.store_steps_left(left);
  return b.CreateAnd(b.CreateICmpSGE(left, b.getInt64(0)), b.CreateNot(e.load_stop()));
}

/// The end of a latch from which a loop is left into a block that fails the run if
/// `exceeds` says so. The builder stands in that block afterwards.
void leave_by_fault(FunctionEmitter& e, Value* goes_on, BasicBlock* header, Value* exceeds) {
  Builder& b = e.builder();
  BasicBlock* leaving = new_block(e, "leaving");
  b.CreateCondBr(goes_on, header, leaving);
  b.SetInsertPoint(leaving);
  Value* left = e.load_steps_left();
  e.store_steps_left(b.CreateSelect(exceeds, b.getInt64(~std::uint64_t{0}), left));
}

Value* end_loop(FunctionEmitter& e, ValueId) {
  const Region region = std::move(e.regions.back());
  e.regions.pop_back();
  Builder& b = e.builder();
  const std::uint32_t imm = e.at(region.open).imm;
  Value* count = b.CreateAdd(region.iteration, e.i32(1));
  Value* below = b.CreateICmpULT(count, e.i32(loop_bound(imm)));
  Value* wants_more = e.any(e.from_stored(region.again, Scalar::b1));
  Value* goes_on = b.CreateAnd(below, wants_more);
  if (e.module().limit().is_counted()) {
    goes_on = b.CreateAnd(goes_on, count_round(e, region.open));
  }
  if (region.active != nullptr) {
    region.active->addIncoming(region.again, b.GetInsertBlock());
  }
  std::vector<Value*> finals;
  for (const Carry& carry : region.carries) {
    // A carry without a next keeps its value.
    finals.push_back(carry.next == no_value ? carry.phi
                                            : e.stored(carry.next, e.lanes_of(carry.next)));
  }
  BasicBlock* latch = b.GetInsertBlock();
  BasicBlock* last = latch;  // The one before `after`.
  if ((imm & loop_must_end) != 0) {
    leave_by_fault(e, goes_on, region.header, b.CreateAnd(wants_more, b.CreateNot(below)));
    last = b.GetInsertBlock();
    b.CreateBr(region.after);
  } else {
    b.CreateCondBr(goes_on, region.header, region.after);
  }
  region.iteration->addIncoming(count, latch);
  b.SetInsertPoint(region.after);
  for (std::size_t k = 0; k < finals.size(); ++k) {
    const Carry& carry = region.carries[k];
    carry.phi->addIncoming(finals[k], latch);
    if (carry.next == no_value) continue;
    llvm::PHINode* final = b.CreatePHI(carry.phi->getType(), 2);
    final->addIncoming(finals[k], last);
    if (!region.always) final->addIncoming(carry.initial, region.before);
    e.define(carry.next, final);
  }
  return nullptr;
}

constexpr std::array<std::pair<Op, EmitOp>, 8> group{{
    {Op::if_any, if_any},
    {Op::merge, merge},
    {Op::end_if, end_if},
    {Op::loop, loop},
    {Op::carry, carry},
    {Op::next, next},
    {Op::again, again},
    {Op::end_loop, end_loop},
}};

}  // namespace

OpGroup region_ops() { return group; }

}  // namespace nacre::codegen
