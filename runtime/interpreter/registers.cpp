#include "runtime/interpreter/registers.h"

#include <algorithm>

#include "runtime/program/region.h"

namespace nacre {

namespace {

/// Lists of values, one an instruction, that share their memory; a value is in one at most.
class ValueLists {
 public:
  explicit ValueLists(std::size_t size) : first_(size, no_value), next_(size, no_value) {}

  void add(std::size_t list, ValueId id) {
    next_[id] = first_[list];
    first_[list] = id;
  }
  /// The latest first.
  template <class F>
  void for_each(std::size_t list, F&& f) const {
    for (ValueId id = first_[list]; id != no_value; id = next_[id]) f(id);
  }

 private:
  std::vector<ValueId> first_, next_;
};

/// For every value, the index of the last instruction that needs it. What a
/// loop uses from outside, and what it carries, lives until the loop's end.
std::vector<std::size_t> last_uses(const Function& function) {
  const std::size_t size = function.code.size();
  const std::vector<std::size_t> region = region_ends(function);
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
      last[mask] = std::max(last[mask], region[i]);
    }
    if (function.code[i].op == Op::next || function.code[i].op == Op::carry) {
      last[i] = std::max(last[i], loop_end[i]);
    }
  }
  return last;
}

/// For every region's opening instruction, the values defined in it that are
/// written when it opens: merges (with their outer value) and nexts.
ValueLists written_on_opening(const Function& function) {
  ValueLists written(function.code.size());
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    const Op op = function.code[i].op;
    if (opens_region(op)) open.push_back(i);
    if (op == Op::merge || op == Op::next || op == Op::carry) {
      written.add(open.back(), static_cast<ValueId>(i));
    }
    if (closes_region(op)) open.pop_back();
  }
  return written;
}

bool needs_register(const Instruction& instruction) { return instruction.type != Scalar::none; }

}  // namespace

RegisterMap assign_registers(const Function& function, const std::vector<bool>& once) {
  const std::vector<std::size_t> last = last_uses(function);
  const auto early = written_on_opening(function);
  RegisterMap map{.of = std::vector<std::uint32_t>(function.code.size(), no_value)};
  std::vector<std::uint32_t> free;
  ValueLists ending(function.code.size());
  const auto give = [&](ValueId id) {
    if (map.of[id] != no_value) return;
    const bool stays = once[id] || function.code[id].op == Op::constant;
    if (stays || free.empty()) {
      map.of[id] = map.count++;
    } else {
      map.of[id] = free.back();
      free.pop_back();
    }
    if (!stays) ending.add(last[id], id);
  };
  for (std::size_t i = 0; i < function.code.size(); ++i) {
    early.for_each(i, give);
    // The result never shares a register with an operand: release afterwards.
    if (needs_register(function.code[i])) give(static_cast<ValueId>(i));
    ending.for_each(i, [&](ValueId id) { free.push_back(map.of[id]); });
  }
  return map;
}

}  // namespace nacre
