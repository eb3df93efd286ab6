#include "runtime/program/fix_inputs.h"

#include "runtime/program/slice.h"

namespace nacre {

Program fix_inputs(const Program& program, const std::function<bool(std::string_view)>& fixed) {
  Program result = program;
  for (Instruction& instruction : result.entry().code) {
    if (instruction.op != Op::input) continue;
    const Channel& channel = program.inputs[instruction.imm];
    if (!fixed(channel.name)) continue;
    instruction.op = Op::parameter;
    instruction.imm = static_cast<std::uint32_t>(result.parameters.size());
    result.parameters.push_back({channel.name, channel.type, 0});
  }
  remove_dead(result);
  mark_varying(result);
  return result;
}

}  // namespace nacre
