#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "jit/passes/range.h"
#include "runtime/program/program.h"
#include "runtime/program/recorder.h"

namespace nacre {

/// Some of a function's values, in order.
using Cone = std::set<ValueId>;

/// Values of a Program's entry by what they depend on: those of a group on one number alone, its
/// key. The Program is marked, and outlives this.
class Groups {
 public:
  /// `constants`: of each slot whether it is as good as a constant; none is where that is empty.
  explicit Groups(const Program& program, std::vector<bool> constants = {});

  /// Whether a value is of such slots alone.
  bool is_of_parameters(ValueId value) const {
    return keys_[value] == no_value && code_[value].op != Op::constant;
  }
  bool has_parameters() const { return !constants_.empty(); }

  /// Keys that are bounded and differ from point to point, and what of their groups is used
  /// elsewhere: in order.
  const std::map<ValueId, std::vector<ValueId>>& outputs() const { return outputs_; }
  const Range& range(ValueId value) const { return ranges_[value]; }
  /// Numbers of a range that cells may part.
  bool is_bounded(ValueId value) const;

  /// Adds what a value is computed from, but for its key; itself included.
  void add_cone(ValueId value, Cone& cone) const;
  /// What values are computed from that depend on `key` alone: a group's, or a value of a group.
  Cone cone_of(const std::vector<ValueId>& values, ValueId key) const;

 private:
  /// The last value that everything of this one goes through, from which a bounded one may begin
  /// anew; no_value of constants.
  ValueId key_of(ValueId value) const;
  void note_uses(ValueId user);

  std::vector<bool> constants_;
  const Function& function_;
  const std::vector<Instruction>& code_;
  std::vector<Range> ranges_;
  std::vector<ValueId> keys_;
  std::map<ValueId, std::vector<ValueId>> outputs_;
};

/// Values that are recorded.
using Refs = std::unordered_map<ValueId, Ref>;

/// Records what is in a cone again, of another number than its key. `instead`: another form of a
/// value, by those before it; null where there is none.
Refs record_again(Recorder& recorder, const Function& function, const Cone& cone, ValueId key,
                  Ref number,
                  const std::function<std::optional<Ref>(ValueId, const Refs&)>& instead = {});

}  // namespace nacre
