#include "runtime/program/program.h"

namespace nacre {

std::span<const ValueId> Function::operands(const Instruction& instruction) const {
  if (instruction.op == Op::call || instruction.op == Op::texture_call) {
    return std::span(pool).subspan(instruction.operands[0], instruction.operands[1]);
  }
  return std::span(instruction.operands).first(instruction.count);
}

std::size_t instruction_count(const Program& program) {
  std::size_t count = 0;
  for (const Function& function : program.functions) count += function.code.size();
  return count;
}

}  // namespace nacre
