#include "jit/passes/sink.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace nacre {

namespace {

/// Regions into which one value is copied, at most.
constexpr std::size_t most_copies = 3;

using RegionId = std::uint32_t;
constexpr RegionId outermost = 0;

struct Region {
  RegionId parent = outermost;
  std::uint32_t depth = 0;
  bool is_loop = false;
  bool is_uniform = false;  ///< All lanes enter it, or none does.
};

/// Where the entry's values are computed, from the last one to the first.
class Places {
 public:
  explicit Places(const Function& entry) : entry_(entry) {
    find_regions();
    find_uses();
    places_.resize(entry_.code.size());
    for (std::size_t id = entry_.code.size(); id-- > 0;) {
      places_[id] = places_of(static_cast<ValueId>(id));
    }
  }

  /// Regions that an instruction stands in, one or several.
  const std::vector<RegionId>& of(ValueId id) const { return places_[id]; }
  RegionId region_of(ValueId id) const { return region_of_[id]; }
  RegionId around(RegionId region) const { return regions_[region].parent; }
  /// The region that it opens.
  RegionId opened_by(ValueId id) const { return opened_by_[id]; }
  bool is_within(RegionId region, RegionId outer) const {
    while (regions_[region].depth > regions_[outer].depth) region = regions_[region].parent;
    return region == outer;
  }

 private:
  const Instruction& at(ValueId id) const { return entry_.code[id]; }

  void find_regions() {
    regions_.emplace_back();
    region_of_.resize(entry_.code.size());
    opened_by_.resize(entry_.code.size());
    RegionId current = outermost;
    for (ValueId id = 0; id < entry_.code.size(); ++id) {
      const Instruction& instruction = at(id);
      if (closes_region(instruction.op)) current = regions_[current].parent;
      region_of_[id] = current;
      if (!opens_region(instruction.op)) continue;
      opened_by_[id] = static_cast<RegionId>(regions_.size());
      const Instruction& mask = at(instruction.operands[0]);
      regions_.push_back({.parent = current,
                          .depth = regions_[current].depth + 1,
                          .is_loop = instruction.op == Op::loop,
                          .is_uniform = mask.op == Op::constant || !mask.varying});
      current = opened_by_[id];
    }
  }

  void find_uses() {
    uses_.resize(entry_.code.size());
    for (ValueId id = 0; id < entry_.code.size(); ++id) {
      for (const ValueId operand : entry_.operands(at(id))) uses_[operand].push_back(id);
    }
  }

  bool may_move(const Instruction& instruction) const {
    switch (instruction.op) {
      case Op::constant:
      case Op::call:
      case Op::texture_call:
      case Op::result:
      case Op::keep:
      case Op::store:
      // Neighbours are read together, which no region is to part.
      case Op::table:
      case Op::texel: return false;
      default: return instruction.varying && !is_structural(instruction.op);
    }
  }
  /// Where a user wants an operand to be.
  void add_wanted(ValueId user, ValueId operand, std::vector<RegionId>& wanted) const {
    const Instruction& instruction = at(user);
    const RegionId around = regions_[region_of_[user]].parent;
    // What lanes have that do not enter is there before the region, as is what a loop begins with.
    if (instruction.op == Op::carry) {
      wanted.push_back(around);
    } else if (instruction.op == Op::merge) {
      if (operand == instruction.operands[0]) wanted.push_back(region_of_[user]);
      if (operand == instruction.operands[1]) wanted.push_back(around);
    } else {
      const std::vector<RegionId>& places = places_[user];
      wanted.insert(wanted.end(), places.begin(), places.end());
    }
  }

  /// The region in `from` that `region` is in or is; nothing if it is `from` itself, or in a loop
  /// there, which would compute the same again and again.
  std::optional<RegionId> step_into(RegionId from, RegionId region) const {
    if (region == from) return std::nullopt;
    while (regions_[region].parent != from) region = regions_[region].parent;
    return regions_[region].is_loop ? std::nullopt : std::optional(region);
  }

  /// The innermost region that has all that is wanted, `from` or in it.
  RegionId innermost(RegionId from, const std::vector<RegionId>& wanted) const {
    while (true) {
      const std::optional<RegionId> next = step_into(from, wanted.front());
      const bool is_one = next && std::ranges::all_of(wanted, [&](RegionId region) {
                            return step_into(from, region) == next;
                          });
      if (!is_one) return from;
      from = *next;
    }
  }

  std::vector<RegionId> places_of(ValueId id) const {
    const RegionId home = region_of_[id];
    if (!may_move(at(id)) || uses_[id].empty()) return {home};
    std::vector<RegionId> wanted;
    for (const ValueId user : uses_[id]) add_wanted(user, id, wanted);
    return copies(innermost(home, wanted), wanted);
  }

  /// In each of the regions in `from` in which something is wanted.
  std::vector<RegionId> copies(RegionId from, const std::vector<RegionId>& wanted) const {
    std::vector<RegionId> steps;
    for (const RegionId region : wanted) {
      const std::optional<RegionId> step = step_into(from, region);
      if (!step || !regions_[*step].is_uniform) return {from};
      if (std::ranges::find(steps, *step) == steps.end()) steps.push_back(*step);
    }
    if (steps.size() > most_copies) return {from};
    std::vector<RegionId> places;
    for (const RegionId step : steps) {
      std::vector<RegionId> part;
      std::ranges::copy_if(wanted, std::back_inserter(part),
                           [&](RegionId region) { return is_within(region, step); });
      places.push_back(innermost(step, part));
    }
    return places;
  }

  const Function& entry_;
  std::vector<Region> regions_;
  std::vector<RegionId> region_of_, opened_by_;  ///< By instruction.
  std::vector<std::vector<ValueId>> uses_;
  std::vector<std::vector<RegionId>> places_;
};

/// Writes the entry again, with everything where it has its place.
class Writer {
 public:
  Writer(const Function& entry, const Places& places)
      : entry_(entry), places_(places), made_(entry.code.size()) {
    for (ValueId id = 0; id < entry_.code.size(); ++id) {
      for (const RegionId place : places_.of(id)) {
        if (place == places_.region_of(id)) continue;
        if (moved_.size() <= place) moved_.resize(place + 1);
        moved_[place].push_back(id);
      }
    }
  }

  Function write() {
    result_.name = entry_.name;
    result_.arguments = entry_.arguments;
    result_.results = entry_.results;
    for (ValueId id = 0; id < entry_.code.size(); ++id) {
      const RegionId home = places_.region_of(id);
      if (std::ranges::find(places_.of(id), home) != places_.of(id).end()) write(id, home);
      if (!opens_region(entry_.code[id].op)) continue;
      const RegionId opened = places_.opened_by(id);
      if (opened >= moved_.size()) continue;
      for (const ValueId each : moved_[opened]) write(each, opened);
    }
    return std::move(result_);
  }

 private:
  struct Made {
    RegionId region;
    ValueId id;
  };

  /// The copy of a value that is seen from a region.
  ValueId seen_from(RegionId region, ValueId id) const {
    const auto found = std::ranges::find_if(
        made_[id], [&](const Made& made) { return places_.is_within(region, made.region); });
    return found->id;
  }

  void write(ValueId id, RegionId region) {
    Instruction instruction = entry_.code[id];
    const auto operands = entry_.operands(entry_.code[id]);
    if (instruction.op == Op::call || instruction.op == Op::texture_call) {
      instruction.operands[0] = static_cast<ValueId>(result_.pool.size());
      for (const ValueId operand : operands) result_.pool.push_back(seen_from(region, operand));
    } else {
      for (std::size_t k = 0; k < operands.size(); ++k) {
        instruction.operands[k] = seen_from(region, operands[k]);
      }
    }
    const auto at = static_cast<ValueId>(result_.code.size());
    // Seen after the region that they end.
    const bool is_result = instruction.op == Op::merge || instruction.op == Op::next;
    made_[id].push_back({is_result ? places_.around(region) : region, at});
    result_.code.push_back(instruction);
  }

  const Function& entry_;
  const Places& places_;
  std::vector<std::vector<Made>> made_;      ///< By instruction.
  std::vector<std::vector<ValueId>> moved_;  ///< By region: what begins it, in order.
  Function result_;
};

}  // namespace

Program sink(const Program& program) {
  Program result = program;
  const Places places(program.entry());
  result.entry() = Writer(program.entry(), places).write();
  return result;
}

}  // namespace nacre
