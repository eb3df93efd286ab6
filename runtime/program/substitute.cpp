#include "runtime/program/substitute.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

namespace nacre {

namespace {

class Substitution {
 public:
  Substitution(Recorder& recorder, const Substitute& by_channel)
      : recorder_(recorder),
        by_channel_(by_channel),
        inputs_(recorder.program().inputs),
        entry_(recorder.program().entry()),
        depends_(entry_.code.size(), false),
        again_(entry_.code.size()) {}

  std::vector<Ref> run(std::span<const Ref> values) {
    mark_dependent();
    const std::vector<bool> needed = needed_for(values);
    const std::uint32_t origin = recorder_.origin();
    for (std::size_t i = 0; i < entry_.code.size(); ++i) {
      if (needed[i]) record_again(i);
    }
    recorder_.set_origin(origin);
    std::vector<Ref> results;
    for (const Ref value : values) {
      results.push_back(value.is_constant() ? value : substituted(value.id));
    }
    return results;
  }

 private:
  /// A region at top level, which is recorded again as one, or an instruction outside of all.
  struct Unit {
    std::size_t first, last;
  };

  /// And the units, in order.
  void mark_dependent() {
    std::size_t depth = 0, first = 0;
    for (std::size_t i = 0; i < entry_.code.size(); ++i) {
      const Instruction& instruction = entry_.code[i];
      if (depth == 0) first = i;
      if (opens_region(instruction.op)) ++depth;
      if (closes_region(instruction.op)) --depth;
      depends_[i] = depends(instruction);
      if (depth > 0) continue;
      const auto begin = depends_.begin() + static_cast<std::ptrdiff_t>(first);
      const auto end = depends_.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      if (std::find(begin, end, true) != end) std::fill(begin, end, true);
      units_.push_back({first, i});
    }
    assert(depth == 0);
  }

  bool depends(const Instruction& instruction) const {
    if (instruction.op == Op::input) {
      return by_channel_(inputs_[instruction.imm].name).has_value();
    }
    const std::span<const ValueId> operands = entry_.operands(instruction);
    return std::ranges::any_of(operands, [&](ValueId operand) { return depends_[operand]; });
  }

  std::vector<bool> needed_for(std::span<const Ref> values) const {
    std::vector<bool> needed(entry_.code.size(), false);
    for (const Ref value : values) {
      if (!value.is_constant() && depends_[value.id]) needed[value.id] = true;
    }
    for (std::size_t k = units_.size(); k-- > 0;) {
      const auto [first, last] = units_[k];
      bool any = false;
      for (std::size_t i = first; i <= last; ++i) any = any || needed[i];
      if (!any) continue;
      for (std::size_t i = first; i <= last; ++i) {
        needed[i] = true;
        for (const ValueId operand : entry_.operands(entry_.code[i])) {
          if (depends_[operand]) needed[operand] = true;
        }
      }
    }
    return needed;
  }

  Ref substituted(ValueId id) {
    return depends_[id] ? again_[id] : Ref{&recorder_, id, entry_.code[id].type};
  }

  void record_again(std::size_t i) {
    const Instruction& instruction = entry_.code[i];
    recorder_.set_origin(instruction.origin);
    std::vector<Ref> operands;
    for (const ValueId operand : entry_.operands(instruction)) {
      operands.push_back(substituted(operand));
    }
    again_[i] = again(instruction, operands);
  }

  Ref again(const Instruction& instruction, std::span<const Ref> operands) {
    switch (instruction.op) {
      case Op::constant: return {nullptr, instruction.imm, instruction.type};
      case Op::parameter: return recorder_.adopted(instruction);
      case Op::input:
        return by_channel_(inputs_[instruction.imm].name).value_or(recorder_.adopted(instruction));
      case Op::keep: return operands[0];
      case Op::if_any: recorder_.begin_if(operands[0]); return {};
      case Op::merge: return recorder_.merge(operands[0], operands[1]);
      case Op::end_if: recorder_.end_if(); return {};
      case Op::loop: recorder_.begin_loop(operands[0], instruction.imm); return {};
      case Op::carry: return recorder_.carry(operands[0]);
      case Op::next: return recorder_.next(operands[0], operands[1]);
      case Op::again: recorder_.again(operands[0]); return {};
      case Op::end_loop: recorder_.end_loop(); return {};
      case Op::call: results_ = recorder_.call(instruction.imm, operands); return {};
      case Op::texture_call:
        results_ = recorder_.texture_call(operands, instruction.imm);
        return {};
      // The results of a call stand right behind it.
      case Op::result: return results_[instruction.imm];
      default: return recorder_.emit(instruction.op, operands, instruction.imm);
    }
  }

  Recorder& recorder_;
  const Substitute& by_channel_;
  // As they were: recording again appends.
  const std::vector<Channel> inputs_;
  const Function entry_;
  std::vector<bool> depends_;  ///< By value; all of a region or nothing.
  std::vector<Ref> again_;     ///< By value.
  std::vector<Unit> units_;
  std::vector<Ref> results_;  ///< Of the last call.
};

}  // namespace

std::vector<Ref> substitute(Recorder& recorder, std::span<const Ref> values,
                            const Substitute& by_channel) {
  assert(recorder.at_top_level());
  return Substitution(recorder, by_channel).run(values);
}

}  // namespace nacre
