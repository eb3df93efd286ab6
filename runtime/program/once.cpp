#include "runtime/program/once.h"

#include <cstddef>

#include "runtime/program/region.h"

namespace nacre {

namespace {

/// Instructions [first, end): a region, or a single one.
bool uniform(const Function& function, std::size_t first, std::size_t end,
             const std::vector<bool>& once) {
  for (std::size_t i = first; i < end; ++i) {
    const Instruction& instruction = function.code[i];
    if (instruction.op == Op::store) return false;
    if (instruction.op != Op::constant && instruction.varying) return false;
    for (const ValueId operand : function.operands(instruction)) {
      const bool is_constant = function.code[operand].op == Op::constant;
      if (operand < first && !once[operand] && !is_constant) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<bool> once_per_call(const Function& entry) {
  std::vector<bool> once(entry.code.size(), false);
  for (std::size_t i = 0; i < entry.code.size();) {
    const std::size_t end = (opens_region(entry.code[i].op) ? region_end(entry, i) : i) + 1;
    const bool all = uniform(entry, i, end, once);
    for (; i < end; ++i) once[i] = all;
  }
  return once;
}

std::vector<bool> once_out_of_regions(const Function& entry) {
  std::vector<bool> once = once_per_call(entry);
  for (std::size_t i = 0; i < once.size(); ++i) {
    const Op op = entry.code[i].op;
    const bool stays = is_structural(op) || op == Op::call || op == Op::texture_call ||
                       op == Op::result || op == Op::keep || op == Op::fitted;
    once[i] = once[i] || (!stays && uniform(entry, i, i + 1, once));
  }
  return once;
}

}  // namespace nacre
