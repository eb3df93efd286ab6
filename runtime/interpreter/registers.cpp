#include "runtime/interpreter/registers.h"

#include <algorithm>

#include "runtime/program/region.h"

namespace nacre {

namespace {

/// For every value, the index of the last instruction that needs it. What a
/// loop uses from outside, and what it carries, lives until the loop's end.
std::vector<std::size_t> last_uses(const Function& function) {
  const std::size_t size = function.code.size();
  std::vector<std::size_t> last(size, 0);
  std::vector<std::size_t> loop_end(size, 0);  // Outermost loop around, or 0.
  std::vector<std::size_t> ends;
  for (std::size_t i = size; i-- > 0;) {
    const Op op = function.code[i].op;
    if (op == Op::end_loop) ends.push_back(i);
    if (!ends.empty()) loop_end[i] = ends.front();
    if (op == Op::loop) ends.pop_back();
  }
  for (std::size_t i = 0; i < size; ++i) {
    last[i] = std::max(last[i], i);
    for (const ValueId operand : function.operands(function.code[i])) {
      last[operand] = std::max({last[operand], i, loop_end[i]});
    }
    // A mask is needed by the merges, up to the region's end.
    if (function.code[i].op == Op::if_any) {
      const ValueId mask = function.code[i].operands[0];
      last[mask] = std::max(last[mask], region_end(function, i));
    }
    if (function.code[i].op == Op::next || function.code[i].op == Op::carry) {
      last[i] = std::max(last[i], loop_end[i]);
    }
  }
  return last;
}

/// For every region's opening instruction, the values defined in it that are
/// written when it opens: merges (with their outer value) and nexts.
std::vector<std::vector<ValueId>> written_on_opening(const Function& function) {
  std::vector<std::vector<ValueId>> written(function.code.size());
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    const Op op = function.code[i].op;
    if (opens_region(op)) open.push_back(i);
    if (op == Op::merge || op == Op::next || op == Op::carry) {
      written[open.back()].push_back(static_cast<ValueId>(i));
    }
    if (closes_region(op)) open.pop_back();
  }
  return written;
}

bool needs_register(const Instruction& instruction) { return instruction.type != Scalar::none; }

}  // namespace

std::vector<bool> once_per_call(const Function& function) {
  std::vector<bool> once(function.code.size(), false);
  int depth = 0;
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    const Instruction& instruction = function.code[i];
    if (closes_region(instruction.op)) --depth;
    once[i] = instruction.op == Op::constant ||
              (depth == 0 && !instruction.varying && !is_structural(instruction.op) &&
               instruction.op != Op::end_if && instruction.op != Op::end_loop);
    // A uniform region is run for every block, so what needs its merges is too.
    for (const ValueId operand : function.operands(instruction)) {
      once[i] = once[i] && once[operand];
    }
    // A merge stands inside its region although it is visible after it.
    if (opens_region(instruction.op)) ++depth;
  }
  return once;
}

RegisterMap assign_registers(const Function& function) {
  const std::vector<std::size_t> last = last_uses(function);
  const std::vector<bool> once = once_per_call(function);
  const auto early = written_on_opening(function);
  RegisterMap map{.of = std::vector<std::uint32_t>(function.code.size(), no_value)};
  std::vector<std::uint32_t> free;
  std::vector<std::vector<ValueId>> ending(function.code.size());
  const auto give = [&](ValueId id) {
    if (map.of[id] != no_value) return;
    if (once[id] || free.empty()) {
      map.of[id] = map.count++;
    } else {
      map.of[id] = free.back();
      free.pop_back();
    }
    if (!once[id]) ending[last[id]].push_back(id);
  };
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    for (const ValueId id : early[i]) give(id);
    // The result never shares a register with an operand: release afterwards.
    if (needs_register(function.code[i])) give(static_cast<ValueId>(i));
    for (const ValueId id : ending[i]) free.push_back(map.of[id]);
  }
  return map;
}

}  // namespace nacre
