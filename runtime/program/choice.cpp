#include "runtime/program/choice.h"

#include <bit>
#include <cstdint>
#include <utility>

namespace nacre {

bool is_limit(const std::vector<Instruction>& code, Ref x, Ref limit) {
  if (x.is_constant() || !limit.is_constant() || 0.0f > std::bit_cast<float>(limit.id)) {
    return false;
  }
  const Instruction& product = code[x.id];
  if (product.op != Op::mul) return false;
  const auto is_zero = [&](ValueId factor) {
    return code[factor].op == Op::constant && (code[factor].imm & 0x7fffffffu) == 0;
  };
  return is_zero(product.operands[0]) || is_zero(product.operands[1]);
}

std::optional<Sides> literal_sides(const std::vector<Instruction>& code,
                                   std::span<const Ref> operands) {
  std::optional<Sides> sides;
  const auto literal = [&](ValueId id) { return Ref{nullptr, code[id].imm, code[id].type}; };
  for (std::size_t k = 0; k < operands.size(); ++k) {
    if (operands[k].is_constant()) continue;
    const Instruction& choice = code[operands[k].id];
    if (choice.op != Op::select) return std::nullopt;
    const auto [condition, yes, no] = choice.operands;
    if (code[yes].op != Op::constant || code[no].op != Op::constant) return std::nullopt;
    if (!sides) sides = Sides{condition, {}, {}};
    if (sides->condition != condition) return std::nullopt;
    sides->yes[k] = literal(yes);
    sides->no[k] = literal(no);
  }
  if (!sides) return std::nullopt;
  for (std::size_t k = 0; k < operands.size(); ++k) {
    if (operands[k].is_constant()) sides->yes[k] = sides->no[k] = operands[k];
  }
  return sides;
}

std::array<Ref, 3> simple_choice(const std::vector<Instruction>& code,
                                 std::span<const Ref> operands) {
  std::array<Ref, 3> choice{operands[0], operands[1], operands[2]};
  const auto definition = [&](Ref x) { return x.is_constant() ? nullptr : &code[x.id]; };
  const auto become = [&](Ref& x, ValueId id) {
    const bool is_literal = code[id].op == Op::constant;
    x = is_literal ? Ref{nullptr, code[id].imm, x.type} : Ref{x.recorder, id, x.type};
  };
  while (const Instruction* negation = definition(choice[0])) {
    if (negation->op != Op::bnot) break;
    become(choice[0], negation->operands[0]);
    std::swap(choice[1], choice[2]);
  }
  if (choice[0].is_constant()) return choice;
  for (const std::size_t side : {1u, 2u}) {
    while (const Instruction* inner = definition(choice[side])) {
      if (inner->op != Op::select || inner->operands[0] != choice[0].id) break;
      become(choice[side], inner->operands[side]);
    }
  }
  return choice;
}

}  // namespace nacre
