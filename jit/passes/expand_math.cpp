#include "jit/passes/expand_math.h"

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "jit/passes/math/functions.h"
#include "jit/passes/range.h"
#include "runtime/program/recorder.h"
#include "runtime/program/transform.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

class Expander {
 public:
  Expander(const Program& program, Accuracy accuracy)
      : entry_(program.entry()), ranges_(ranges_of(program)), accuracy_(accuracy) {}

  std::optional<Ref> expand(Recorder& recorder, const Instruction& instruction,
                            std::span<const Ref> operands) {
    if (!is_transcendental(instruction.op)) return std::nullopt;
    bool all_constant = true;
    for (const Ref operand : operands) all_constant = all_constant && operand.is_constant();
    if (all_constant) return std::nullopt;  // Folds, correctly rounded.
    const Float x(operands[0]);
    const auto angle = [&] { return this->angle(recorder, x, size(instruction)); };
    const auto half_turn_angle = [&] {
      return accuracy_ == Accuracy::fast ? reduce_half_turns(x) : angle();
    };
    switch (instruction.op) {
      case Op::sin: return approximate_sin(x, half_turn_angle(), accuracy_).ref();
      case Op::cos: return approximate_cos(half_turn_angle(), accuracy_).ref();
      case Op::tan: return approximate_tan(x, angle(), accuracy_).ref();
      case Op::asin: return approximate_asin(x, accuracy_).ref();
      case Op::acos: return approximate_acos(x, accuracy_).ref();
      case Op::atan2: return approximate_atan2(x, Float(operands[1]), accuracy_).ref();
      case Op::exp: return approximate_exp(x, accuracy_).ref();
      case Op::exp2: return approximate_exp2(x, accuracy_).ref();
      case Op::log: return approximate_log(x, accuracy_).ref();
      case Op::log2: return approximate_log2(x, accuracy_).ref();
      case Op::pow: return approximate_pow(recorder, x, Float(operands[1]), accuracy_).ref();
      default: return std::nullopt;
    }
  }

 private:
  /// What an operand of the entry's is known to be.
  AngleSize size(const Instruction& instruction) const {
    const std::less<const Instruction*> before;
    const Instruction* const first = entry_.code.data();
    if (before(&instruction, first) || !before(&instruction, first + entry_.code.size())) {
      return AngleSize::any;
    }
    const Range& range = ranges_[entry_.operands(instruction)[0]];
    const bool is_small =
        !range.nan && -largest_small_angle <= range.low && range.high <= largest_small_angle;
    return is_small ? AngleSize::small : AngleSize::any;
  }

  /// The angle of x. Equal operations share by themselves, but the path for
  /// large angles is a region, which would stand once for each function of x.
  Angle angle(Recorder& recorder, Float x, AngleSize size) {
    Angle& known = angles_[{recorder.current_function(), x.ref().id}];
    const Ref rest = known.rest.ref();
    if (rest.is_constant() || !recorder.visible(rest)) {
      known = reduce_angle(recorder, x, accuracy_, size);
    }
    return known;
  }

  const Function& entry_;
  std::vector<Range> ranges_;
  Accuracy accuracy_;
  std::map<std::pair<std::uint32_t, ValueId>, Angle> angles_;  ///< By function and argument.
};

}  // namespace

Program expand_math(const Program& program, Accuracy accuracy, std::size_t most) {
  Expander expander(program, accuracy);
  const auto expand = [&](Recorder& recorder, const Instruction& instruction,
                          std::span<const Ref> operands) {
    return expander.expand(recorder, instruction, operands);
  };
  Program result = transform(program, expand, most);
  mark_varying(result);
  return result;
}

}  // namespace nacre
