#include "runtime/program/value_table.h"

#include <algorithm>
#include <cstdint>

namespace nacre {

namespace {

std::uint32_t hash_of(const Instruction& key) {
  std::uint64_t h = static_cast<std::uint64_t>(key.op) | static_cast<std::uint64_t>(key.type) << 8 |
                    static_cast<std::uint64_t>(key.imm) << 16;
  for (const ValueId operand : key.operands) {
    h = (h ^ operand) * 0x9e3779b97f4a7c15ull;
    h ^= h >> 29;
  }
  return static_cast<std::uint32_t>(h);
}

}  // namespace

ValueId ValueTable::find(const Function& function, const Instruction& instruction) const {
  const std::uint32_t hash = hash_of(instruction);
  const auto is_it = [&](const Slot& slot) {
    return slot.hash == hash && function.code[slot.id] == instruction;
  };
  return slots_[slot_where(hash, is_it)].id;
}

void ValueTable::add(const Function& function, ValueId id) {
  if (2 * (added_.size() + 1) > slots_.size()) grow();
  added_.push_back({id, hash_of(function.code[id])});
  put(added_.back());
}

void ValueTable::put(const Slot& slot) {
  slots_[slot_where(slot.hash, [](const Slot&) { return false; })] = slot;
}

void ValueTable::grow() {
  slots_.assign(4 * slots_.size(), {});
  for (const Slot& slot : added_) put(slot);
}

void ValueTable::close_scope() {
  for (; added_.size() > scopes_.back(); added_.pop_back()) {
    const Slot& last = added_.back();
    slots_[slot_where(last.hash, [&](const Slot& slot) { return slot.id == last.id; })] = {};
  }
  scopes_.pop_back();
}

}  // namespace nacre
