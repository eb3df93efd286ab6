#include "jit/passes/decide.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "jit/passes/range_arithmetic.h"
#include "runtime/program/transform.h"

namespace nacre {

namespace {

/// Nothing where it is not certain.
using Outcome = std::optional<bool>;

// Of NaN the first three are false, as op.h has it.

Outcome is_less(const Range& a, const Range& b) {
  if (a.low >= b.high) return false;
  return !a.nan && !b.nan && a.high < b.low ? Outcome(true) : std::nullopt;
}

Outcome is_at_most(const Range& a, const Range& b) {
  if (a.low > b.high) return false;
  return !a.nan && !b.nan && a.high <= b.low ? Outcome(true) : std::nullopt;
}

Outcome is_equal(const Range& a, const Range& b) {
  if (a.low > b.high || b.low > a.high) return false;
  return is_point(a) && is_point(b) ? Outcome(true) : std::nullopt;
}

Outcome negation(Outcome outcome) { return outcome ? Outcome(!*outcome) : outcome; }

bool is_zero(const Range& a) { return is_point(a) && a.low == 0; }
bool is_positive(const Range& a) { return a.low > 0 || (a.low == 0 && !may_be_minus_zero(a)); }

/// What is certain of the entry's operations.
class Decider {
 public:
  Decider(const Program& program, const Known& known)
      : code_(program.entry().code), ranges_(ranges_of(program, known)) {}

  std::optional<Ref> instead_of(const Instruction& x, std::span<const Ref> operands) const {
    if (!is_of_entry(x)) return std::nullopt;
    if (const std::optional<Ref> number = number_of(x)) return number;
    if (const Outcome outcome = outcome_of(x)) return Ref::literal(*outcome);
    if (const std::optional<std::size_t> same = same_as(x)) return operands[*same];
    return std::nullopt;
  }

 private:
  bool is_of_entry(const Instruction& x) const {
    const std::less<const Instruction*> before;
    return !before(&x, code_.data()) && before(&x, code_.data() + code_.size());
  }
  const Range& of(const Instruction& x, std::size_t operand) const {
    return ranges_[x.operands[operand]];
  }

  /// The one number that it is.
  std::optional<Ref> number_of(const Instruction& x) const {
    const Range& range = ranges_[static_cast<std::size_t>(&x - code_.data())];
    if (!is_point(range)) return std::nullopt;
    if (x.type == Scalar::i32) return Ref::literal(static_cast<std::int32_t>(range.low));
    const auto number = static_cast<float>(range.low);
    const bool is_float = x.type == Scalar::f32 && double(number) == range.low;
    if (!is_float || may_be_minus_zero(range)) return std::nullopt;
    return Ref::literal(number + 0.0f);  // Of a range from -0 to 0 too.
  }

  Outcome outcome_of(const Instruction& x) const {
    switch (x.op) {
      case Op::lt:
      case Op::ilt: return is_less(of(x, 0), of(x, 1));
      case Op::le: return is_at_most(of(x, 0), of(x, 1));
      case Op::eq: return are_equal(x);
      case Op::ne: return negation(are_equal(x));
      case Op::ieq: return is_equal(of(x, 0), of(x, 1));
      default: return std::nullopt;
    }
  }

  Outcome are_equal(const Instruction& x) const {
    // How a number is asked whether it is NaN.
    if (x.operands[0] == x.operands[1] && !of(x, 0).nan) return true;
    return is_equal(of(x, 0), of(x, 1));
  }

  /// Which of its operands it is, if that is certain.
  std::optional<std::size_t> same_as(const Instruction& x) const {
    switch (x.op) {
      case Op::min:
        if (const auto least = end_of_multiples(x)) return 1 - *least;
        return chosen(of(x, 0), of(x, 1), of(x, 0), of(x, 1));
      case Op::max:
        if (const auto most = end_of_multiples(x)) return most;
        return chosen(of(x, 0), of(x, 1), of(x, 1), of(x, 0));
      case Op::abs:
        if (!of(x, 0).nan && is_positive(of(x, 0))) return 0;
        return std::nullopt;
      case Op::add:
        // -0 + 0 is 0.
        if (is_zero(of(x, 0)) && !may_be_minus_zero(of(x, 1))) return 1;
        if (is_zero(of(x, 1)) && !may_be_minus_zero(of(x, 0))) return 0;
        return std::nullopt;
      case Op::sub:
        // -0 - -0 is 0.
        if (is_zero(of(x, 1)) && !may_be_minus_zero(of(x, 1))) return 0;
        return std::nullopt;
      case Op::fma:
        // Of what is finite 0 makes 0 or -0.
        if (is_nothing(of(x, 0), of(x, 1)) && !may_be_minus_zero(of(x, 2))) return 2;
        return std::nullopt;
      default: return std::nullopt;
    }
  }

  /// Which operand is larger of two that are one number times others of known order, as what passes
  /// to a base is times the channels of its colour.
  std::optional<std::size_t> end_of_multiples(const Instruction& x) const {
    const Instruction& a = code_[x.operands[0]];
    const Instruction& b = code_[x.operands[1]];
    if (a.op != Op::mul || b.op != Op::mul) return std::nullopt;
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        const Range& common = of(a, i);
        if (a.operands[i] != b.operands[k] || common.nan || !is_positive(common)) continue;
        const Range &of_a = of(a, 1 - i), &of_b = of(b, 1 - k);
        if (!is_positive(of_a) || !is_positive(of_b) || !common.is_bounded()) continue;
        if (is_at_most(of_b, of_a) == true) return 0;
        if (is_at_most(of_a, of_b) == true) return 1;
      }
    }
    return std::nullopt;
  }

  /// Whether the product of both is 0, of either sign.
  static bool is_nothing(const Range& a, const Range& b) {
    return (is_zero(a) && b.is_bounded()) || (is_zero(b) && a.is_bounded());
  }

  /// Of less < more ? a : b.
  static std::optional<std::size_t> chosen(const Range& a, const Range& b, const Range& less,
                                           const Range& more) {
    if (const Outcome outcome = is_less(less, more)) return *outcome ? 0 : 1;
    if (is_at_most(less, more) != true) return std::nullopt;
    // Where they are equal it is the second, which is the first but for zeros of two signs.
    const bool have_zeros = has_zero(a) && has_zero(b);
    const bool have_one_sign = !may_be_minus_zero(a) && !may_be_minus_zero(b);
    return have_zeros && !have_one_sign ? std::nullopt : std::optional<std::size_t>(0);
  }

  const std::vector<Instruction>& code_;
  const std::vector<Range> ranges_;
};

Program decide_once(const Program& program, const Known& known, std::size_t most) {
  const Decider decider(program, known);
  return transform(
      program,
      [&](Recorder&, const Instruction& x, std::span<const Ref> operands) {
        return decider.instead_of(x, operands);
      },
      most, {}, {}, true);
}

}  // namespace

Program decide(const Program& program, const Known& known, std::size_t most) {
  // What is left out makes other things plain: which side of a surface is seen, what its normal is.
  constexpr int most_rounds = 3;
  Program result = program;
  for (int round = 0; round < most_rounds; ++round) {
    Program next = decide_once(result, known, most);
    const bool is_done = instruction_count(next) == instruction_count(result);
    result = std::move(next);
    if (is_done || instruction_count(result) > most) break;
  }
  mark_varying(result);
  return result;
}

}  // namespace nacre
