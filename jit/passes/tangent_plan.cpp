#include "jit/passes/tangent_plan.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "jit/passes/footprint.h"
#include "jit/passes/tangent.h"

namespace nacre {

namespace {

bool is_constant(const Function& function, ValueId id, std::uint32_t bits) {
  const Instruction& instruction = function.code[id];
  return instruction.op == Op::constant && instruction.imm == bits;
}

/// An i32 that is 0 but for its sign bit.
bool is_sign_bit(const Function& function, ValueId id) {
  if (is_constant(function, id, 0x80000000u)) return true;
  const Instruction& mask = function.code[id];
  return mask.op == Op::iand && (is_constant(function, mask.operands[0], 0x80000000u) ||
                                 is_constant(function, mask.operands[1], 0x80000000u));
}

/// The float whose bits the i32 `id` is, with at most the sign bit changed.
ValueId float_but_for_sign(const Function& function, ValueId id) {
  const Instruction& word = function.code[id];
  if (word.op == Op::bits) return word.operands[0];
  if (word.op != Op::ior && word.op != Op::ixor && word.op != Op::iand) return no_value;
  for (std::size_t k = 0; k < 2; ++k) {
    const Instruction& source = function.code[word.operands[k]];
    const ValueId other = word.operands[1 - k];
    const bool only_sign = word.op == Op::iand ? is_constant(function, other, 0x7fffffffu)
                                               : is_sign_bit(function, other);
    if (source.op == Op::bits && only_sign) return source.operands[0];
  }
  return no_value;
}

std::vector<bool> find_ddx(const Program& program) {
  std::vector<bool> found(program.functions.size(), false);
  const auto search = [&](std::size_t index) {
    for (const Instruction& instruction : program.functions[index].code) {
      const bool calls_one = instruction.op == Op::call && found[instruction.imm];
      if (instruction.op == Op::ddx || calls_one) found[index] = true;
    }
  };
  // Callees stand before their callers, but for the entry.
  for (std::size_t i = 1; i < found.size(); ++i) search(i);
  search(0);
  return found;
}

}  // namespace

std::array<ValueId, 3> tangent_operands(const Function& function, ValueId id) {
  std::array<ValueId, 3> result{no_value, no_value, no_value};
  const Instruction& instruction = function.code[id];
  if (instruction.op == Op::from_bits) {
    result[0] = float_but_for_sign(function, instruction.operands[0]);
    return result;
  }
  if (tangent_rule(instruction.op) == nullptr) return result;
  for (std::size_t k = 0; k < instruction.count; ++k) {
    const ValueId operand = instruction.operands[k];
    if (function.code[operand].type == Scalar::f32) result[k] = operand;
  }
  return result;
}

TangentPlanner::TangentPlanner(const Program& program, std::span<const std::string_view> more,
                               bool force)
    : program_(program), more_(more), force_(force), has_ddx_(find_ddx(program)) {}

const TangentPlan& TangentPlanner::entry() { return plan(0, {}, {}); }

// -- Forward: what can have a tangent ------------------------------------------

const TangentPlanner::Activity& TangentPlanner::activity(std::uint32_t function,
                                                         const Bits& arguments) {
  std::unique_ptr<Activity>& found = activities_[{function, arguments}];
  if (found != nullptr) return *found;
  const Function& body = program_.functions[function];
  auto fresh = std::make_unique<Activity>();
  fresh->values.assign(body.code.size(), 0);
  fresh->results.assign(body.results.size(), 0);
  while (flow_forward(body, arguments, *fresh)) {
  }
  // A callee's entry may have been added meanwhile; references into a map stay.
  found = std::move(fresh);
  return *found;
}

bool TangentPlanner::flow_forward(const Function& function, const Bits& arguments,
                                  Activity& found) {
  bool changed = false;
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    const Instruction& instruction = function.code[i];
    const auto id = static_cast<ValueId>(i);
    const TangentBits bits = found.values[i] | bits_of(function, id, arguments, found);
    if (instruction.op == Op::give) found.results[instruction.imm] |= bits;
    if (instruction.op == Op::next) {
      TangentBits& carry = found.values[instruction.operands[0]];
      changed = changed || (carry | bits) != carry;
      carry |= bits;
    }
    changed = changed || bits != found.values[i];
    found.values[i] = bits;
  }
  return changed;
}

TangentBits TangentPlanner::bits_of(const Function& function, ValueId id, const Bits& arguments,
                                    const Activity& found) {
  const Instruction& instruction = function.code[id];
  const auto of = [&](std::size_t k) { return found.values[instruction.operands[k]]; };
  switch (instruction.op) {
    case Op::input:
      return instruction.type == Scalar::f32 &&
                     derivative_channel(program_.inputs[instruction.imm].name, 0, more_)
                 ? tangent_axes
                 : TangentBits{0};
    case Op::argument: return arguments[instruction.imm];
    case Op::merge:
    case Op::next: return of(0) | of(1);
    case Op::carry:
    case Op::keep:
    case Op::give: return of(0);
    case Op::result: return call_result_bits(function, id, found);
    case Op::stand_in: return of(1);
    case Op::ddx: return !force_ && of(0) != 0 ? tangent_later : TangentBits{0};
    default: break;
  }
  TangentBits bits = 0;
  for (const ValueId operand : tangent_operands(function, id)) {
    if (operand != no_value) bits |= found.values[operand];
  }
  return bits;
}

TangentBits TangentPlanner::call_result_bits(const Function& function, ValueId id,
                                             const Activity& found) {
  const Instruction& result = function.code[id];
  const Instruction& call = function.code[result.operands[0]];
  if (call.op != Op::call) return 0;  // A texture_call: its derivative is taken to be 0.
  const Bits arguments = argument_bits(function, result.operands[0], found.values);
  return activity(call.imm, arguments).results[result.imm];
}

TangentPlanner::Bits TangentPlanner::argument_bits(const Function& function, ValueId call,
                                                   const Bits& active) const {
  Bits bits;
  for (const ValueId operand : function.operands(function.code[call])) {
    bits.push_back(active[operand]);
  }
  return bits;
}

// -- Backward: whose tangent is needed -----------------------------------------

const TangentPlan& TangentPlanner::plan(std::uint32_t function, const Bits& arguments,
                                        const Bits& results) {
  std::unique_ptr<TangentPlan>& found = plans_[{function, arguments, results}];
  if (found != nullptr) return *found;
  auto fresh = std::make_unique<TangentPlan>();
  const Function& body = program_.functions[function];
  fresh->function = function;
  fresh->active = activity(function, arguments).values;
  fresh->needed.assign(body.code.size(), 0);
  fresh->callee.assign(body.code.size(), nullptr);
  fresh->arguments_needed.assign(body.arguments.size(), 0);
  fresh->results_needed = results;
  fresh->results_needed.resize(body.results.size(), 0);
  flow_backward(*fresh);
  found = std::move(fresh);
  return *found;
}

void TangentPlanner::flow_backward(TangentPlan& plan) {
  const Function& body = program_.functions[plan.function];
  while (sweep_backward(plan)) {
  }
  for (std::size_t i = 0; i < body.code.size(); ++i) {
    const Instruction& instruction = body.code[i];
    if (instruction.op == Op::argument) {
      plan.arguments_needed[instruction.imm] |= plan.needed[i];
    }
  }
}

bool TangentPlanner::need(TangentPlan& plan, ValueId id, TangentBits bits) const {
  TangentBits& needed = plan.needed[id];
  const TangentBits more = needed | (bits & plan.active[id] & tangent_axes);
  return std::exchange(needed, more) != more;
}

bool TangentPlanner::sweep_backward(TangentPlan& plan) {
  const Function& body = program_.functions[plan.function];
  bool changed = false;
  for (std::size_t i = body.code.size(); i-- > 0;) {
    const Instruction& instruction = body.code[i];
    const auto id = static_cast<ValueId>(i);
    const TangentBits bits = plan.needed[i];
    const auto need_operand = [&](std::size_t k, TangentBits wanted) {
      changed = need(plan, instruction.operands[k], wanted) || changed;
    };
    switch (instruction.op) {
      case Op::give: need_operand(0, plan.results_needed[instruction.imm]); break;
      case Op::ddx:
        if (plan.is_ready(body, id)) need_operand(0, axis_bit(instruction.imm));
        break;
      case Op::merge:
        need_operand(0, bits);
        need_operand(1, bits);
        break;
      case Op::next: {  // The tangent of a carry is carried, or neither is.
        const TangentBits both = bits | plan.needed[instruction.operands[0]];
        changed = need(plan, id, both) || changed;
        need_operand(0, both);
        need_operand(1, both);
        break;
      }
      case Op::carry:
      case Op::keep: need_operand(0, bits); break;
      case Op::stand_in: need_operand(1, bits); break;
      case Op::call: changed = need_call(plan, id) || changed; break;
      default:
        for (const ValueId operand : tangent_operands(body, id)) {
          if (operand != no_value) changed = need(plan, operand, bits) || changed;
        }
        break;
    }
  }
  return changed;
}

bool TangentPlanner::need_call(TangentPlan& caller, ValueId id) {
  const Function& body = program_.functions[caller.function];
  const std::uint32_t function = body.code[id].imm;
  Bits results(program_.functions[function].results.size(), 0);
  // Results follow their call.
  for (std::size_t i = id + 1; i < body.code.size(); ++i) {
    const Instruction& instruction = body.code[i];
    if (instruction.op == Op::result && instruction.operands[0] == id) {
      results[instruction.imm] |= caller.needed[i];
    } else if (instruction.op == Op::call) {
      break;
    }
  }
  Bits arguments = argument_bits(body, id, caller.active);
  const bool plain = !has_ddx_[function] &&
                     std::ranges::count(results, 0) == static_cast<std::ptrdiff_t>(results.size());
  if (plain) std::ranges::fill(arguments, 0);
  const TangentPlan& callee = plan(function, arguments, results);
  caller.callee[id] = &callee;
  bool changed = false;
  const auto operands = body.operands(body.code[id]);
  for (std::size_t k = 0; k < operands.size(); ++k) {
    changed = need(caller, operands[k], callee.arguments_needed[k]) || changed;
  }
  return changed;
}

}  // namespace nacre
