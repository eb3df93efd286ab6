#include "runtime/program/transform.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/program/slice.h"

namespace nacre {

namespace {

class Transformer {
 public:
  Transformer(const Program& program, const Replacement& replace, std::size_t most,
              const Flattening& flattens, bool keeps_sign)
      : program_(program),
        replace_(replace),
        most_(most),
        flattens_(flattens),
        functions_(program.functions.size(), 0) {
    recorder_.adopt_interface(program);
    if (keeps_sign) recorder_.keep_sign_of_zero();
  }

  Program run(const Finish& finish) {
    // Callees stand before their callers; the entry is first but comes last.
    for (std::size_t i = 1; i < program_.functions.size(); ++i) {
      if (!outlined(i)) return too_large(most_);
    }
    if (!body(program_.entry())) return too_large(most_);
    if (finish) finish(recorder_);
    Program result = recorder_.take();
    remove_dead(result, true);
    assert(verify(result).empty());
    return result;
  }

 private:
  bool outlined(std::size_t index) {
    const Function& function = program_.functions[index];
    recorder_.begin_function(std::to_string(index) + '/' + function.name, function.name,
                             function.arguments);
    std::vector<Ref> results(function.results.size());
    gives_ = &results;
    if (!body(function)) return false;
    gives_ = nullptr;
    functions_[index] = recorder_.end_function(results);
    return true;
  }

  /// False once there is too much.
  bool body(const Function& function) {
    std::size_t here = 0;
    std::vector<Ref> operands;
    values_.assign(function.code.size(), Ref{});
    for (std::size_t i = 0; i < function.code.size(); ++i) {
      const Instruction& instruction = function.code[i];
      recorder_.set_origin(instruction.origin);
      operands.clear();
      for (const ValueId operand : function.operands(instruction)) {
        operands.push_back(values_[operand]);
      }
      if (instruction.op == Op::if_any) {
        if (operands[0].is_constant(0u)) {
          i = past_region(function, i);
          continue;
        }
        const bool is_flat = operands[0].is_constant() || (flattens_ && flattens_(function, i));
        ifs_.push_back(is_flat ? std::optional(operands[0]) : std::nullopt);
      }
      values_[i] = again(instruction, operands);
      if (!values_[i].is_constant()) here = std::max<std::size_t>(here, values_[i].id);
      if (done_ + here > most_) return false;
    }
    done_ += here;
    return true;
  }

  /// Of an if_any region that no lane enters: what is merged is what there was. Its last
  /// instruction.
  std::size_t past_region(const Function& function, std::size_t open) {
    std::size_t depth = 1, i = open;
    while (depth > 0) {
      const Instruction& instruction = function.code[++i];
      if (opens_region(instruction.op)) ++depth;
      if (closes_region(instruction.op)) --depth;
      // Literals stand where they are used.
      if (instruction.op == Op::constant) values_[i] = again(instruction, {});
      if (depth == 1 && instruction.op == Op::merge) values_[i] = values_[instruction.operands[1]];
    }
    return i;
  }

  Ref again(const Instruction& instruction, std::span<const Ref> operands) {
    switch (instruction.op) {
      case Op::constant: return {nullptr, instruction.imm, instruction.type};
      case Op::parameter:
      case Op::input: {
        const std::optional<Ref> replaced = replace_(recorder_, instruction, operands);
        return replaced ? *replaced : recorder_.adopted(instruction);
      }
      case Op::argument: return recorder_.argument(instruction.imm);
      case Op::if_any:
        if (!ifs_.back()) recorder_.begin_if(operands[0]);
        return {};
      case Op::merge:
        if (!ifs_.back()) return recorder_.merge(operands[0], operands[1]);
        return recorder_.emit(Op::select, std::array{*ifs_.back(), operands[0], operands[1]});
      case Op::end_if:
        if (!ifs_.back()) recorder_.end_if();
        ifs_.pop_back();
        return {};
      case Op::loop: recorder_.begin_loop(operands[0], instruction.imm); return {};
      case Op::carry: return recorder_.carry(operands[0]);
      case Op::next: return recorder_.next(operands[0], operands[1]);
      case Op::again: recorder_.again(operands[0]); return {};
      case Op::end_loop: recorder_.end_loop(); return {};
      case Op::call: results_ = recorder_.call(functions_[instruction.imm], operands); return {};
      case Op::texture_call:
        results_ = recorder_.texture_call(operands, instruction.imm);
        return {};
      case Op::result: return results_[instruction.imm];
      case Op::give: (*gives_)[instruction.imm] = operands[0]; return {};
      case Op::store:
        recorder_.store(program_.outputs[instruction.imm].name, operands[0]);
        return {};
      default: break;
    }
    if (const std::optional<Ref> replaced = replace_(recorder_, instruction, operands)) {
      return *replaced;
    }
    return recorder_.emit(instruction.op, operands, instruction.imm);
  }

  const Program& program_;
  const Replacement& replace_;
  const std::size_t most_;
  const Flattening& flattens_;
  std::size_t done_ = 0;  ///< Instructions of the functions before this one.
  Recorder recorder_;
  std::vector<std::uint32_t> functions_;  ///< Old index to new.
  std::vector<Ref> values_;               ///< Old value to new, in this function.
  std::vector<Ref> results_;              ///< Of the last call.
  std::vector<Ref>* gives_ = nullptr;
  /// Of the if_any regions that are open: their masks where they are flattened.
  std::vector<std::optional<Ref>> ifs_;
};

}  // namespace

Program transform(const Program& program, const Replacement& replace, std::size_t most,
                  const Flattening& flattens, const Finish& finish, bool keeps_sign) {
  return Transformer(program, replace, most, flattens, keeps_sign).run(finish);
}

Program too_large(std::size_t most) {
  Program result;
  result.entry().code.resize(most + 1);
  return result;
}

}  // namespace nacre
