#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "jit/llvm/gather.h"
#include "jit/llvm/lookup.h"
#include "jit/llvm/ops.h"
#include "runtime/program/fold.h"

namespace nacre::codegen {

namespace {

using llvm::Value;

constexpr std::uint32_t margin = ModuleEmitter::table_margin;

Value* clamp(FunctionEmitter& e, Value* index, std::int32_t low, std::uint32_t high, int lanes) {
  Value* least = e.i32(static_cast<std::uint32_t>(low), lanes);
  index = e.builder().CreateBinaryIntrinsic(llvm::Intrinsic::smax, index, least);
  return e.builder().CreateBinaryIntrinsic(llvm::Intrinsic::smin, index, e.i32(high, lanes));
}

/// An index x & mask that needs no clamp: the mask is below the number of entries.
struct MaskedIndex {
  ValueId unmasked;
  std::uint32_t mask;
};
std::optional<MaskedIndex> masked_index(const FunctionEmitter& e, ValueId index,
                                        std::uint32_t last) {
  const Instruction& found = e.at(index);
  if (found.op != Op::iand) return std::nullopt;
  for (const std::size_t k : {0, 1}) {
    const Instruction& mask = e.at(found.operands[k]);
    if (mask.op == Op::constant && mask.imm <= last) {
      return MaskedIndex{found.operands[1 - k], mask.imm};
    }
  }
  return std::nullopt;
}

/// The entries that follow each other from `index` on: one load a lane.
void emit_run(FunctionEmitter& e, const std::vector<ValueId>& run, Value* index, int lanes) {
  Builder& b = e.builder();
  const std::uint32_t number = e.at(run.front()).imm;
  const auto& values = e.module().program().tables[number].values;
  // The copies of the first and last entries around the table answer for indices
  // outside, so that one clamp serves the whole run.
  const auto last = static_cast<std::uint32_t>(values.size() - 1);
  Value* first = clamp(e, index, -static_cast<std::int32_t>(margin), last, lanes);
  first = b.CreateAdd(first, e.i32(margin, lanes));
  Value* around = e.module().table_data(number);
  const auto entries = gather_run(e, {Scalar::f32, around}, first, lanes, run.size());
  Value* lowest = e.f32_bits(flush_denormal(std::bit_cast<std::uint32_t>(values.front())), lanes);
  e.define(run[0], entries[0]);
  for (std::size_t k = 1; k < run.size(); ++k) {
    if (run[k] == no_value) continue;
    // index + k may wrap around, to below the table.
    const auto most = static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max() - k);
    Value* wraps = b.CreateICmpSGT(index, e.i32(most, lanes));
    e.define(run[k], b.CreateSelect(wraps, lowest, entries[k]));
  }
}

Value* table(FunctionEmitter& e, ValueId id) {
  if (e.defined(id) != nullptr) return nullptr;  // By a run.
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  const auto& values = e.module().program().tables[instruction.imm].values;
  const auto last = static_cast<std::uint32_t>(values.size() - 1);
  const auto masked = masked_index(e, instruction.operands[0], last);
  Value* index = e.operand(instruction, 0, lanes);
  if (fits_registers(e.module().features(), values.size(), lanes)) {
    if (!masked) {
      index = clamp(e, index, 0, last, lanes);
    } else if (masked->mask == last &&
               ignores_high_bits(e.module().features(), values.size(), lanes)) {
      index = e.use(masked->unmasked, lanes);
    }
    return look_up_in_registers(e, values, index, lanes);
  }
  const auto run = lanes > 1 ? e.word_run(id) : std::vector<ValueId>{id};
  if (run.size() > 1) {
    emit_run(e, run, index, lanes);
    return nullptr;
  }
  if (!masked) index = clamp(e, index, 0, last, lanes);
  index = e.builder().CreateAdd(index, e.i32(margin, lanes));
  return gather(e, {Scalar::f32, e.module().table_data(instruction.imm)}, index, lanes);
}

/// A row of the fitted numbers is as many as one register holds, or two.
Value* fitted(FunctionEmitter& e, ValueId id) {
  const Instruction& instruction = e.at(id);
  const int lanes = e.lanes_of(id);
  Builder& b = e.builder();
  Value* rows = e.load_invariant(
      b.getPtrTy(), e.byte_offset(e.kernel_arguments, offsetof(KernelArguments, fitted)), "fitted");
  Value* row = e.byte_offset(rows, std::size_t{instruction.imm} * Fit::cells * sizeof(float));
  Value* index = e.operand(instruction, 0, lanes);
  if (!ignores_high_bits(e.module().features(), Fit::cells, lanes)) {
    index = b.CreateAnd(index, e.i32(Fit::cells - 1, lanes));
  }
  return look_up_in_row(e, row, Fit::cells, index, lanes);
}

constexpr std::array<std::pair<Op, EmitOp>, 2> group{{{Op::table, table}, {Op::fitted, fitted}}};

}  // namespace

OpGroup table_ops() { return group; }

}  // namespace nacre::codegen
