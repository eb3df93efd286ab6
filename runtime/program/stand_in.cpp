#include "runtime/program/stand_in.h"

#include <optional>

#include "runtime/program/transform.h"

namespace nacre {

Program with_stand_ins(const Program& program, std::size_t operand, std::size_t most) {
  const auto replace = [&](Recorder& recorder, const Instruction& instruction,
                           std::span<const Ref> operands) -> std::optional<Ref> {
    static_cast<void>(recorder);
    if (instruction.op != Op::stand_in) return std::nullopt;
    return operands[operand];
  };
  Program result = transform(program, replace, most);
  mark_varying(result);
  return result;
}

}  // namespace nacre
