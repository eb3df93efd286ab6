#pragma once

#include <cstddef>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// Finds the value of a function that equals an instruction to be recorded, of those in
/// scope: a hash table of value ids, whose keys are the function's instructions.
class ValueTable {
 public:
  ValueTable() : slots_(64, empty) {}

  /// The value that this instruction has, or no_value.
  ValueId find(const Function& function, const Instruction& instruction) const;
  /// Value `id` of the function, which find() does not find yet.
  void add(const Function& function, ValueId id);

  /// What is added between the two goes out of scope.
  void open_scope() { scopes_.push_back(added_.size()); }
  void close_scope(const Function& function);

 private:
  static constexpr ValueId empty = no_value;

  /// The slot that has the instruction, or the empty one where it would go.
  std::size_t slot_of(const Function& function, const Instruction& instruction) const;
  void grow(const Function& function);

  std::vector<ValueId> slots_;  ///< A power of two of them, at most half of them taken.
  /// In this order, so that those that go first were the last to find a slot: nothing was
  /// put behind them.
  std::vector<ValueId> added_;
  std::vector<std::size_t> scopes_;
};

}  // namespace nacre
