#include "jit/passes/derive.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "jit/passes/footprint.h"
#include "jit/passes/scale_footprints.h"
#include "jit/passes/tangent.h"
#include "jit/passes/tangent_plan.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/program/stand_in.h"
#include "runtime/program/transform.h"

namespace nacre {

namespace {

Ref zero() { return Ref::literal(0.0f); }

/// A value and its tangents along x and y.
struct Dual {
  Ref value;
  std::array<Ref, 2> d{zero(), zero()};
};

/// A tangent that crosses a call: of argument or result k, along an axis.
struct Crossing {
  std::size_t k;
  std::uint32_t axis;
};

/// In the order in which they follow the plain arguments or results.
std::vector<Crossing> crossings(const std::vector<TangentBits>& needed) {
  std::vector<Crossing> list;
  for (std::size_t k = 0; k < needed.size(); ++k) {
    for (const std::uint32_t axis : {0u, 1u}) {
      if ((needed[k] & axis_bit(axis)) != 0) list.push_back({k, axis});
    }
  }
  return list;
}

/// t where it is finite, else 0.
Ref finite(Ref tangent) {
  if (tangent.is_constant()) return tangent;
  const Float t(tangent);
  return select(abs(t) < Float(std::numeric_limits<float>::infinity()), t, 0.0f).ref();
}

/// Records a Program again with its ready ddx operations replaced.
class Deriver {
 public:
  Deriver(const Program& program, std::span<const std::string_view> more, bool force,
          std::size_t most)
      : program_(program), more_(more), most_(most), planner_(program, more, force) {
    recorder_.adopt_interface(program);
  }

  Program run() {
    const TangentPlan& plan = planner_.entry();
    if (!outline_callees(plan) || !body(plan)) return too_large(most_);
    Program result = recorder_.take();
    remove_dead(result);
    mark_varying(result);
    assert(verify(result).empty());
    return result;
  }

 private:
  // Each of these is false once there is too much.

  bool outline_callees(const TangentPlan& plan) {
    return std::ranges::all_of(plan.callee, [&](const TangentPlan* callee) {
      return callee == nullptr || outlined_.contains(callee) || outline(*callee);
    });
  }

  bool outline(const TangentPlan& plan) {
    if (!outline_callees(plan)) return false;
    const Function& function = program_.functions[plan.function];
    std::vector<Scalar> arguments = function.arguments;
    const std::vector<Crossing> in = crossings(plan.arguments_needed);
    arguments.insert(arguments.end(), in.size(), Scalar::f32);
    recorder_.begin_function(std::to_string(outlined_.size()), function.name, arguments);
    gives_.assign(function.results.size(), Dual{});
    if (!body(plan)) return false;
    std::vector<Ref> results;
    for (const Dual& give : gives_) results.push_back(give.value);
    for (const auto [k, axis] : crossings(plan.results_needed)) {
      results.push_back(gives_[k].d[axis]);
    }
    outlined_.emplace(&plan, recorder_.end_function(results));
    return true;
  }

  bool body(const TangentPlan& plan) {
    plan_ = &plan;
    function_ = &program_.functions[plan.function];
    values_.assign(function_->code.size(), Dual{});
    std::size_t here = 0;
    for (std::size_t i = 0; i < function_->code.size(); ++i) {
      values_[i] = again(static_cast<ValueId>(i));
      const Ref value = values_[i].value;
      if (!value.is_constant()) here = std::max<std::size_t>(here, value.id);
      if (done_ + here > most_) return false;
    }
    done_ += here;
    return true;
  }

  /// f(axis) for the axes along which value id needs a tangent.
  template <class F>
  void for_each_axis(ValueId id, F&& f) const {
    for (const std::uint32_t axis : {0u, 1u}) {
      if ((plan_->needed[id] & axis_bit(axis)) != 0) f(axis);
    }
  }

  /// The instruction recorded again, and its tangents beside it.
  Dual again(ValueId id) {
    const Instruction& instruction = function_->code[id];
    recorder_.set_origin(instruction.origin);
    const auto at = [&](std::size_t k) -> const Dual& { return values_[instruction.operands[k]]; };
    Dual dual;
    switch (instruction.op) {
      case Op::constant: return {.value = {nullptr, instruction.imm, instruction.type}};
      case Op::parameter: {
        const ParameterSlot& slot = program_.parameters[instruction.imm];
        return {.value = recorder_.parameter(slot.name, slot.type, slot.value)};
      }
      case Op::input: return input(id);
      case Op::argument: return argument(id);
      case Op::if_any: recorder_.begin_if(at(0).value); return {};
      case Op::merge:
        dual.value = recorder_.merge(at(0).value, at(1).value);
        for_each_axis(id, [&](std::uint32_t axis) {
          dual.d[axis] = recorder_.merge(at(0).d[axis], at(1).d[axis]);
        });
        return dual;
      case Op::end_if: recorder_.end_if(); return {};
      case Op::loop: recorder_.begin_loop(at(0).value, instruction.imm); return {};
      case Op::carry:
        dual.value = recorder_.carry(at(0).value);
        for_each_axis(id,
                      [&](std::uint32_t axis) { dual.d[axis] = recorder_.carry(at(0).d[axis]); });
        return dual;
      case Op::next:
        dual.value = recorder_.next(at(0).value, at(1).value);
        for_each_axis(id, [&](std::uint32_t axis) {
          dual.d[axis] = recorder_.next(at(0).d[axis], at(1).d[axis]);
        });
        return dual;
      case Op::again: recorder_.again(at(0).value); return {};
      case Op::end_loop: recorder_.end_loop(); return {};
      case Op::call: call(id); return {};
      case Op::texture_call:
        results_.clear();
        for (const Ref result : recorder_.texture_call(operand_values(id), instruction.imm)) {
          results_.push_back({.value = result});
        }
        return {};
      case Op::result: return results_[instruction.imm];
      case Op::give: gives_[instruction.imm] = at(0); return {};
      case Op::store:
        recorder_.store(program_.outputs[instruction.imm].name, at(0).value);
        return {};
      case Op::keep:
        return {.value = recorder_.emit(Op::keep, operand_values(id), instruction.imm),
                .d = at(0).d};
      case Op::stand_in:
        return {.value = recorder_.emit(Op::stand_in, operand_values(id)), .d = at(1).d};
      case Op::ddx:
        if (!plan_->is_ready(*function_, id)) break;
        return {.value = derivative(instruction)};
      default: break;
    }
    return operation(id);
  }

  std::vector<Ref> operand_values(ValueId id) const {
    std::vector<Ref> refs;
    for (const ValueId operand : function_->operands(function_->code[id])) {
      refs.push_back(values_[operand].value);
    }
    return refs;
  }

  Dual input(ValueId id) {
    const Channel& channel = program_.inputs[function_->code[id].imm];
    Dual dual{.value = recorder_.input(channel.name, channel.type)};
    for_each_axis(id, [&](std::uint32_t axis) {
      const auto name = derivative_channel(channel.name, static_cast<int>(axis), more_);
      dual.d[axis] = recorder_.input(*name, Scalar::f32);
    });
    return dual;
  }

  Dual argument(ValueId id) {
    const std::uint32_t number = function_->code[id].imm;
    Dual dual{.value = recorder_.argument(number)};
    auto next = static_cast<std::uint32_t>(function_->arguments.size());
    for (const auto [k, axis] : crossings(plan_->arguments_needed)) {
      if (k == number) dual.d[axis] = recorder_.argument(next);
      ++next;
    }
    return dual;
  }

  Ref derivative(const Instruction& ddx) const {
    const ValueId operand = ddx.operands[0];
    const Ref tangent = values_[operand].d[ddx.imm];
    // A channel is what the host says it is.
    return function_->code[operand].op == Op::input ? tangent : finite(tangent);
  }

  void call(ValueId id) {
    const TangentPlan& callee = *plan_->callee[id];
    const auto operands = function_->operands(function_->code[id]);
    std::vector<Ref> arguments = operand_values(id);
    for (const auto [k, axis] : crossings(callee.arguments_needed)) {
      arguments.push_back(values_[operands[k]].d[axis]);
    }
    const std::vector<Ref> refs = recorder_.call(outlined_.at(&callee), arguments);
    std::size_t next = callee.results_needed.size();
    results_.assign(next, Dual{});
    for (std::size_t k = 0; k < results_.size(); ++k) results_[k].value = refs[k];
    for (const auto [k, axis] : crossings(callee.results_needed)) {
      results_[k].d[axis] = refs[next++];
    }
  }

  Dual operation(ValueId id) {
    const Instruction& instruction = function_->code[id];
    Dual dual{.value = recorder_.emit(instruction.op, operand_values(id), instruction.imm)};
    if (plan_->needed[id] == 0) return dual;
    const auto sources = tangent_operands(*function_, id);
    TangentStep step;
    step.y = Float(dual.value);
    if (instruction.op == Op::select) step.condition = Bool(values_[instruction.operands[0]].value);
    for (std::size_t k = 0; k < sources.size(); ++k) {
      if (sources[k] != no_value) step.x[k] = Float(values_[sources[k]].value);
    }
    for_each_axis(id, [&](std::uint32_t axis) {
      for (std::size_t k = 0; k < sources.size(); ++k) {
        if (sources[k] != no_value) step.d[k] = Float(values_[sources[k]].d[axis]);
      }
      dual.d[axis] = tangent_rule(instruction.op)(step).ref();
    });
    return dual;
  }

  const Program& program_;
  std::span<const std::string_view> more_;
  const std::size_t most_;
  std::size_t done_ = 0;  ///< Instructions of the functions before this one.
  TangentPlanner planner_;
  Recorder recorder_;
  std::unordered_map<const TangentPlan*, std::uint32_t> outlined_;  ///< Function in the recording.

  // Of the function being recorded.
  const TangentPlan* plan_ = nullptr;
  const Function* function_ = nullptr;
  std::vector<Dual> values_;   ///< By old value.
  std::vector<Dual> results_;  ///< Of the last call.
  std::vector<Dual> gives_;    ///< By result.
};

bool has_ddx(const Program& program) {
  return std::ranges::any_of(program.functions, [](const Function& function) {
    return std::ranges::find(function.code, Op::ddx, &Instruction::op) != function.code.end();
  });
}

}  // namespace

Program derive(const Program& program, std::span<const std::string_view> more, std::size_t most) {
  Program result = program;
  // Each round resolves the ddx operations that hold no other; the last one all.
  for (int order = 1; has_ddx(result) && order <= max_derivative_order; ++order) {
    result = Deriver(result, more, order == max_derivative_order, most).run();
  }
  // No derivative is asked for any more.
  result = with_stand_ins(result, 0, most);
  keep_footprint_scale(program, result);
  return result;
}

}  // namespace nacre
