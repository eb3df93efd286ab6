#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// Finds the value of a function that equals an instruction to be recorded, of those in
/// scope: a hash table of value ids, whose keys are the function's instructions. Most of what
/// it is asked for is not there, and known by its hash to be not.
class ValueTable {
 public:
  ValueTable() : slots_(1024) {}

  /// The value that this instruction has, or no_value.
  ValueId find(const Function& function, const Instruction& instruction) const;
  /// Value `id` of the function, which find() does not find yet.
  void add(const Function& function, ValueId id);

  /// What is added between the two goes out of scope.
  void open_scope() { scopes_.push_back(added_.size()); }
  void close_scope();  ///< The second of the two.

 private:
  struct Slot {
    ValueId id = no_value;   ///< Empty without one.
    std::uint32_t hash = 0;  ///< Of its instruction, which most others need not be compared with.
  };

  /// The first slot of those for a hash that is empty or `is_it`.
  template <class F>
  std::size_t slot_where(std::uint32_t hash, F&& is_it) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = hash & mask;
    while (slots_[i].id != no_value && !is_it(slots_[i])) i = (i + 1) & mask;
    return i;
  }
  void put(const Slot& slot);
  void grow();

  std::vector<Slot> slots_;  ///< A power of two of them, at most half of them taken.
  /// In this order, so that those that go first were the last to find a slot: nothing was
  /// put behind them.
  std::vector<Slot> added_;
  std::vector<std::size_t> scopes_;
};

}  // namespace nacre
