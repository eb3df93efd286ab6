#include "jit/passes/tabulate/groups.h"

#include <algorithm>
#include <utility>

namespace nacre {

namespace {

/// Wider ranges have no cells worth the name.
constexpr double widest_range = 64;

bool is_pure(Op op) {
  switch (op) {
    case Op::constant:
    case Op::parameter:
    case Op::input:
    case Op::argument:
    case Op::fitted:
    case Op::texel:
    case Op::texture_call:
    case Op::result:
    case Op::call:
    case Op::keep:
    case Op::ddx: return false;
    default: return !is_structural(op);
  }
}

}  // namespace

Groups::Groups(const Program& program, std::vector<bool> constants)
    : constants_(std::move(constants)),
      function_(program.entry()),
      code_(function_.code),
      ranges_(ranges_of(program)) {
  for (ValueId i = 0; i < code_.size(); ++i) keys_.push_back(key_of(i));
  for (ValueId i = 0; i < code_.size(); ++i) note_uses(i);
}

void Groups::add_cone(ValueId value, Cone& cone) const {
  std::vector<ValueId> left{value};  // Chains may be as long as a Program.
  while (!left.empty()) {
    const ValueId next = left.back();
    left.pop_back();
    const bool ends = keys_[next] == next || code_[next].op == Op::constant;
    if (ends || !cone.insert(next).second) continue;
    for (const ValueId operand : function_.operands(code_[next])) left.push_back(operand);
  }
}

Cone Groups::cone_of(const std::vector<ValueId>& values, ValueId key) const {
  Cone cone;
  for (const ValueId value : values) add_cone(value, cone);
  // What the key itself is computed from.
  std::erase_if(cone, [&](ValueId value) { return value <= key && !is_of_parameters(value); });
  return cone;
}

bool Groups::is_bounded(ValueId value) const {
  const Range& range = ranges_[value];
  return is_pure(code_[value].op) && code_[value].type == Scalar::f32 && range.is_bounded() &&
         range.high > range.low && range.high - range.low <= widest_range;
}

ValueId Groups::key_of(ValueId value) const {
  if (code_[value].op == Op::constant) return no_value;
  if (has_parameters() && !code_[value].varying) {
    const Instruction& instruction = code_[value];
    const bool is_constant =
        instruction.op == Op::parameter ? constants_[instruction.imm] : is_pure(instruction.op);
    const auto counts = [&](ValueId operand) { return keys_[operand] == no_value; };
    if (is_constant && std::ranges::all_of(function_.operands(instruction), counts)) {
      return no_value;
    }
  }
  if (!is_pure(code_[value].op)) return value;
  ValueId key = no_value;
  for (const ValueId operand : function_.operands(code_[value])) {
    const ValueId of = keys_[operand];
    if (of == no_value || of == key) continue;
    if (key != no_value) return value;
    key = of;
  }
  if (key == no_value) return value;
  return is_bounded(value) && !is_bounded(key) ? value : key;
}

void Groups::note_uses(ValueId user) {
  for (const ValueId used : function_.operands(code_[user])) {
    const ValueId key = keys_[used];
    if (key == no_value || key == used || keys_[user] == key) continue;
    if (!is_bounded(key) || !code_[key].varying) continue;
    std::vector<ValueId>& list = outputs_[key];
    if (std::ranges::find(list, used) == list.end()) list.push_back(used);
  }
}

Refs record_again(Recorder& recorder, const Function& function, const Cone& cone, ValueId key,
                  Ref number,
                  const std::function<std::optional<Ref>(ValueId, const Refs&)>& instead) {
  Refs again{{key, number}};
  std::vector<Ref> operands;
  const auto record = [&](ValueId i) {
    if (const auto other = instead ? instead(i, again) : std::nullopt) return *other;
    operands.clear();
    for (const ValueId operand : function.operands(function.code[i])) {
      const Instruction& found = function.code[operand];
      operands.push_back(found.op == Op::constant ? Ref{nullptr, found.imm, found.type}
                                                  : again.at(operand));
    }
    if (function.code[i].op == Op::parameter) return recorder.adopted(function.code[i]);
    return recorder.emit(function.code[i].op, operands, function.code[i].imm);
  };
  // What is there once for all points first: what is computed of it has one form then, whoever else
  // has needed it before.
  for (const bool is_varying : {false, true}) {
    for (const ValueId i : cone) {
      if (i != key && function.code[i].varying == is_varying) again[i] = record(i);
    }
  }
  return again;
}

}  // namespace nacre
