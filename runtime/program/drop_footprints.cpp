#include "runtime/program/drop_footprints.h"

#include "runtime/program/slice.h"

namespace nacre {

Program drop_footprints(const Program& program) {
  Program result = program;
  for (Function& function : result.functions) {
    for (Instruction& instruction : function.code) {
      if (instruction.op != Op::ddx) continue;
      instruction = {
          .op = Op::constant, .type = Scalar::f32, .imm = 0, .origin = instruction.origin};
    }
  }
  remove_dead(result);
  mark_varying(result);
  return result;
}

}  // namespace nacre
