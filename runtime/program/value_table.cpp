#include "runtime/program/value_table.h"

#include <algorithm>
#include <cstdint>

namespace nacre {

namespace {

std::size_t hash(const Instruction& key) {
  std::uint64_t h = static_cast<std::uint64_t>(key.op) | static_cast<std::uint64_t>(key.type) << 8 |
                    static_cast<std::uint64_t>(key.imm) << 16;
  for (const ValueId operand : key.operands) {
    h = (h ^ operand) * 0x9e3779b97f4a7c15ull;
    h ^= h >> 29;
  }
  return static_cast<std::size_t>(h);
}

}  // namespace

std::size_t ValueTable::slot_of(const Function& function, const Instruction& instruction) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = hash(instruction) & mask;
  while (slots_[i] != empty && function.code[slots_[i]] != instruction) i = (i + 1) & mask;
  return i;
}

ValueId ValueTable::find(const Function& function, const Instruction& instruction) const {
  return slots_[slot_of(function, instruction)];
}

void ValueTable::add(const Function& function, ValueId id) {
  if (2 * (added_.size() + 1) > slots_.size()) grow(function);
  slots_[slot_of(function, function.code[id])] = id;
  added_.push_back(id);
}

void ValueTable::grow(const Function& function) {
  slots_.assign(2 * slots_.size(), empty);
  for (const ValueId id : added_) slots_[slot_of(function, function.code[id])] = id;
}

void ValueTable::close_scope(const Function& function) {
  for (; added_.size() > scopes_.back(); added_.pop_back()) {
    slots_[slot_of(function, function.code[added_.back()])] = empty;
  }
  scopes_.pop_back();
}

}  // namespace nacre
