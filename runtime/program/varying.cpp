#include "runtime/program/program.h"

namespace nacre {

namespace {

/// One forward sweep; true if something became varying. A loop's carries are
/// uniform until a varying value, or a varying mask, reaches them.
bool sweep(Function& function, bool all) {
  bool changed = false;
  std::vector<std::size_t> opened;  // The opening instructions of the regions around.
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    Instruction& instruction = function.code[i];
    bool varying =
        instruction.varying || all || instruction.op == Op::input || instruction.op == Op::argument;
    for (const ValueId operand : function.operands(instruction)) {
      varying = varying || function.code[operand].varying;
    }
    switch (instruction.op) {
      case Op::if_any:
      case Op::loop: opened.push_back(i); break;
      case Op::again: varying = varying || function.code[opened.back()].varying; break;
      case Op::merge:
      case Op::next: varying = varying || function.code[opened.back()].varying; break;
      case Op::end_if:
      case Op::end_loop: opened.pop_back(); break;
      default: break;
    }
    if (instruction.op == Op::constant && !all) varying = false;
    if (varying == instruction.varying) continue;
    instruction.varying = varying;
    changed = true;
    // The region's own mark carries what its mask and `again` are.
    if (instruction.op == Op::again) function.code[opened.back()].varying = true;
    if (instruction.op == Op::next) function.code[instruction.operands[0]].varying = true;
  }
  return changed;
}

}  // namespace

void mark_varying(Program& program, bool all) {
  for (Function& function : program.functions) {
    for (Instruction& instruction : function.code) instruction.varying = false;
    while (sweep(function, all)) {
    }
  }
}

}  // namespace nacre
