#include "jit/passes/expand_math.h"

#include <map>
#include <optional>
#include <span>
#include <utility>

#include "jit/passes/math/functions.h"
#include "runtime/program/recorder.h"
#include "runtime/program/transform.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

class Expander {
 public:
  explicit Expander(Accuracy accuracy) : accuracy_(accuracy) {}

  std::optional<Ref> expand(Recorder& recorder, const Instruction& instruction,
                            std::span<const Ref> operands) {
    if (!is_transcendental(instruction.op)) return std::nullopt;
    bool all_constant = true;
    for (const Ref operand : operands) all_constant = all_constant && operand.is_constant();
    if (all_constant) return std::nullopt;  // Folds, correctly rounded.
    const Float x(operands[0]);
    switch (instruction.op) {
      case Op::sin: return approximate_sin(x, half_turn_angle(recorder, x), accuracy_).ref();
      case Op::cos: return approximate_cos(half_turn_angle(recorder, x), accuracy_).ref();
      case Op::tan: return approximate_tan(x, angle(recorder, x), accuracy_).ref();
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
  Angle half_turn_angle(Recorder& recorder, Float x) {
    return accuracy_ == Accuracy::fast ? reduce_half_turns(x) : angle(recorder, x);
  }

  /// The angle of x. Equal operations share by themselves, but the path for
  /// large angles is a region, which would stand once for each function of x.
  Angle angle(Recorder& recorder, Float x) {
    Angle& known = angles_[{recorder.current_function(), x.ref().id}];
    const Ref rest = known.rest.ref();
    if (rest.is_constant() || !recorder.visible(rest)) {
      known = reduce_angle(recorder, x, accuracy_);
    }
    return known;
  }

  Accuracy accuracy_;
  std::map<std::pair<std::uint32_t, ValueId>, Angle> angles_;  ///< By function and argument.
};

}  // namespace

Program expand_math(const Program& program, Accuracy accuracy, std::size_t most) {
  Expander expander(accuracy);
  const auto expand = [&](Recorder& recorder, const Instruction& instruction,
                          std::span<const Ref> operands) {
    return expander.expand(recorder, instruction, operands);
  };
  Program result = transform(program, expand, most);
  mark_varying(result);
  return result;
}

}  // namespace nacre
