#include "jit/llvm/word_run.h"

#include <algorithm>

namespace nacre::codegen {

namespace {

/// A word's number as a value and a constant added to it.
struct Place {
  ValueId base;
  std::uint32_t offset;
};

Place place_of(const Function& function, const Instruction& read) {
  const ValueId word = read.operands[read.op == Op::texel ? 1 : 0];
  const Instruction& instruction = function.code[word];
  if (instruction.op != Op::iadd) return {word, 0};
  for (const std::size_t k : {0u, 1u}) {
    const Instruction& constant = function.code[instruction.operands[k]];
    if (constant.op == Op::constant) return {instruction.operands[1 - k], constant.imm};
  }
  return {word, 0};
}

bool same_array(const Instruction& a, const Instruction& b) {
  if (a.op != b.op) return false;
  return a.op == Op::texel ? a.operands[0] == b.operands[0] : a.imm == b.imm;
}

/// Instructions after the first that are looked through.
constexpr std::size_t horizon = 64;

}  // namespace

std::vector<ValueId> word_run(const Function& function, ValueId first,
                              const std::function<bool(ValueId)>& goes_along) {
  const Instruction& start = function.code[first];
  const Place place = place_of(function, start);
  std::vector<ValueId> run(4, no_value);
  run[0] = first;
  const std::size_t end = std::min(function.code.size(), first + horizon);
  for (std::size_t i = first + 1; i < end; ++i) {
    const Instruction& instruction = function.code[i];
    if (opens_region(instruction.op) || closes_region(instruction.op)) break;
    if (!same_array(instruction, start) || !goes_along(static_cast<ValueId>(i))) continue;
    const Place other = place_of(function, instruction);
    const std::uint32_t distance = other.offset - place.offset;
    if (other.base != place.base || distance == 0 || distance >= run.size()) continue;
    if (run[distance] == no_value) run[distance] = static_cast<ValueId>(i);
  }
  const bool beyond_two = run[2] != no_value || run[3] != no_value;
  run.resize(beyond_two ? 4 : run[1] != no_value ? 2 : 1);
  return run;
}

}  // namespace nacre::codegen
