#include "runtime/program/program.h"

namespace nacre {

namespace {

/// Which arguments of a function differ from lane to lane, by index.
using Arguments = std::vector<bool>;

/// One forward sweep; true if something before what makes it so became varying: then what
/// reads it has to be looked at again. A loop's carries are uniform until a varying value, or
/// a varying mask, reaches them.
bool sweep(Function& function, const Arguments& arguments, bool all) {
  bool changed = false;
  const auto mark_before = [&](ValueId id) {
    changed = changed || !function.code[id].varying;
    function.code[id].varying = true;
  };
  std::vector<std::size_t> opened;  // The opening instructions of the regions around.
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    Instruction& instruction = function.code[i];
    bool varying = instruction.varying || all || instruction.op == Op::input ||
                   (instruction.op == Op::argument && arguments[instruction.imm]);
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
    // The region's own mark carries what its mask and `again` are.
    if (instruction.op == Op::again) mark_before(static_cast<ValueId>(opened.back()));
    if (instruction.op == Op::next) mark_before(instruction.operands[0]);
  }
  return changed;
}

}  // namespace

void mark_varying(Program& program, bool all, bool all_arguments) {
  std::vector<Arguments> arguments;
  for (const Function& function : program.functions) {
    arguments.emplace_back(function.arguments.size(), all_arguments);
  }
  const auto mark = [&](Function& function, const Arguments& own) {
    for (Instruction& instruction : function.code) instruction.varying = false;
    while (sweep(function, own, all)) {
    }
    for (const Instruction& call : function.code) {
      if (call.op != Op::call) continue;
      const auto operands = function.operands(call);
      for (std::size_t k = 0; k < operands.size(); ++k) {
        if (function.code[operands[k]].varying) arguments[call.imm][k] = true;
      }
    }
  };
  // Callers before what they call: the entry, and then from the last one on.
  mark(program.entry(), arguments[0]);
  for (std::size_t i = program.functions.size(); i-- > 1;) {
    mark(program.functions[i], arguments[i]);
  }
}

std::vector<bool> uniform_arguments(const Function& function) {
  std::vector<bool> uniform(function.arguments.size(), false);
  for (const Instruction& instruction : function.code) {
    if (instruction.op == Op::argument && !instruction.varying) uniform[instruction.imm] = true;
  }
  return uniform;
}

}  // namespace nacre
