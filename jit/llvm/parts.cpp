#include "jit/llvm/parts.h"

#include <algorithm>

#include "runtime/program/region.h"

namespace nacre::codegen {

namespace {

/// The places of values of one size.
class Places {
 public:
  std::uint32_t take() {
    if (free_.empty()) return count_++;
    const std::uint32_t place = free_.back();
    free_.pop_back();
    return place;
  }
  void give_back(std::uint32_t place) { free_.push_back(place); }
  std::uint32_t count() const { return count_; }

 private:
  std::vector<std::uint32_t> free_;
  std::uint32_t count_ = 0;
};

/// Instructions of a region, with those that open and close it.
struct Range {
  std::size_t first = 1, last = 0;
  bool contains(std::size_t id) const { return first <= id && id <= last; }
};

class Cutter {
 public:
  Cutter(const Function& entry, const std::vector<bool>& once, std::size_t most)
      : entry_(entry), once_(once), most_(most), ends_(region_ends(entry)) {
    for (const bool part : {true, false}) {
      for (ValueId id = 0; id < entry.code.size(); ++id) {
        if (once[id] == part && entry.code[id].op != Op::constant) order_.push_back(id);
      }
    }
    parts_.home.assign(entry.code.size(), 0);
    parts_.place.assign(entry.code.size(), Parts::nowhere);
  }

  Parts cut(int lanes) {
    find_homes();
    if (parts_.count != 0) {
      number_steps();
      find_last_uses();
      give_places(static_cast<std::size_t>(lanes) * sizeof(float));
    }
    return std::move(parts_);
  }

 private:
  void find_homes() {
    Range region;  // That goes along with its first instruction.
    for (const ValueId id : order_) {
      const Instruction& instruction = entry_.code[id];
      const bool goes_along = region.contains(id) || instruction.op == Op::result;
      if (goes_along) {
        if (in_part_) add(id);
        continue;
      }
      const bool opens = opens_region(instruction.op);
      const std::size_t size = opens ? ends_[id] - id + 1 : 1;
      const bool stays = size > most_ || (!opens && is_structural(instruction.op));
      const bool changes_pass = in_part_ && once_[id] != once_[members_.back()];
      if (in_part_ && (stays || changes_pass || members_.size() + size > most_)) end_part();
      if (stays) continue;
      add(id);
      if (opens) region = {id, ends_[id]};
    }
    end_part();
  }

  void add(ValueId id) {
    in_part_ = true;
    members_.push_back(id);
  }

  void end_part() {
    // Few are not worth a call.
    if (!members_.empty() && members_.size() >= most_ / 20) {
      ++parts_.count;
      for (const ValueId id : members_) parts_.home[id] = parts_.count;
    }
    members_.clear();
    in_part_ = false;
  }

  /// What is emitted in one go is a step: a part, or an instruction of the entry itself.
  void number_steps() {
    step_.assign(entry_.code.size(), 0);
    std::uint32_t before = 0;
    for (const ValueId id : order_) {
      const std::uint32_t home = parts_.home[id];
      if (home == 0 || home != before) ++steps_;
      before = home;
      step_[id] = steps_;
    }
    ++steps_;
  }

  void find_last_uses() {
    last_.assign(entry_.code.size(), 0);
    Range loop;  // The outermost around, of those in the entry itself.
    for (const ValueId id : order_) {
      const Instruction& instruction = entry_.code[id];
      const bool is_own = parts_.home[id] == 0;
      if (!loop.contains(id) && is_own && instruction.op == Op::loop) loop = {id, ends_[id]};
      // The mask of a region is looked at up to its end.
      std::uint32_t use = is_own && opens_region(instruction.op) ? step_[ends_[id]] : step_[id];
      if (loop.contains(id)) use = std::max(use, step_[loop.last]);
      for (const ValueId operand : entry_.operands(instruction)) {
        if (entry_.code[operand].op == Op::constant) continue;
        last_[operand] = std::max(last_[operand], use);
        if (!parts_.same_home(id, operand)) crosses(operand);
      }
    }
  }

  void crosses(ValueId id) {
    if (parts_.place[id] != Parts::nowhere) return;
    parts_.place[id] = 0;  // Somewhere.
    crossing_.push_back(id);
  }

  void give_places(std::size_t vector_bytes) {
    Places scalars, vectors;
    const auto places_of = [&](ValueId id) -> Places& {
      return entry_.code[id].varying ? vectors : scalars;
    };
    std::ranges::sort(crossing_, {}, [&](ValueId id) { return step_[id]; });
    std::vector<std::vector<ValueId>> ending(steps_ + 1);
    std::uint32_t freed = 0;
    for (const ValueId id : crossing_) {
      // What a part makes may not lie where it still reads.
      for (; freed < step_[id]; ++freed) {
        for (const ValueId gone : ending[freed]) places_of(gone).give_back(parts_.place[gone]);
      }
      parts_.place[id] = places_of(id).take();
      // The batches to come need what is computed once.
      if (!once_[id]) ending[last_[id]].push_back(id);
    }
    const std::size_t vectors_end =
        (vector_bytes * vectors.count() + sizeof(double) - 1) / sizeof(double) * sizeof(double);
    for (const ValueId id : crossing_) {
      const std::size_t number = parts_.place[id];
      const bool is_vector = entry_.code[id].varying;
      parts_.place[id] = static_cast<std::uint32_t>(
          is_vector ? vector_bytes * number : vectors_end + sizeof(double) * number);
    }
    parts_.frame_bytes = vectors_end + sizeof(double) * scalars.count();
  }

  const Function& entry_;
  const std::vector<bool>& once_;
  const std::size_t most_;
  const std::vector<std::size_t> ends_;
  std::vector<ValueId> order_;  ///< As it is emitted, without constants.
  Parts parts_;
  std::vector<ValueId> members_;  ///< Of the part that is being made.
  bool in_part_ = false;
  std::vector<std::uint32_t> step_;  ///< By instruction.
  std::uint32_t steps_ = 0;
  std::vector<std::uint32_t> last_;  ///< By value: the last step that needs it.
  std::vector<ValueId> crossing_;
};

}  // namespace

Parts cut_into_parts(const Function& entry, const std::vector<bool>& once,
                     const CodegenOptions& options) {
  if (entry.code.size() <= options.uncut) return {};
  return Cutter(entry, once, options.part).cut(options.lanes);
}

}  // namespace nacre::codegen
