#include "runtime/program/stand_in.h"

#include <algorithm>
#include <optional>

#include "runtime/program/slice.h"
#include "runtime/program/transform.h"

namespace nacre {

Program with_stand_ins(const Program& program, std::size_t operand, std::size_t most) {
  const auto replace = [&](Recorder& /*recorder*/, const Instruction& instruction,
                           std::span<const Ref> operands) -> std::optional<Ref> {
    if (instruction.op != Op::stand_in) return std::nullopt;
    return operands[operand];
  };
  const bool has_any = std::ranges::any_of(program.functions, [](const Function& function) {
    return std::ranges::find(function.code, Op::stand_in, &Instruction::op) != function.code.end();
  });
  if (!has_any) return program;
  Program result = transform(program, replace, most);
  remove_dead(result);
  mark_varying(result);
  return result;
}

}  // namespace nacre
