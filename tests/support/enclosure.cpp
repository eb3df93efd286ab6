#include "tests/support/enclosure.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <optional>
#include <utility>

#include "runtime/program/fold.h"
#include "runtime/program/region.h"

namespace nacre::testing {

namespace {

constexpr Enclosure any{-std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::infinity(), true};

/// f of an f32; i of an i32, where it is known; and what a b1 may be.
struct Value {
  Enclosure f;
  std::optional<std::uint32_t> i;
  bool may_be_true = false;
  bool may_be_false = false;

  bool is_open() const { return may_be_true && may_be_false; }
};

Value number(const Enclosure& x) { return {.f = x, .i = {}}; }
Value integer(std::optional<std::uint32_t> x) { return {.f = {}, .i = x}; }
Value truth(bool may_be_true, bool may_be_false) {
  return {.f = {}, .i = {}, .may_be_true = may_be_true, .may_be_false = may_be_false};
}
Value open_value() { return {.f = any, .i = {}, .may_be_true = true, .may_be_false = true}; }

Value unite(const Value& a, const Value& b) {
  return {.f = unite(a.f, b.f),
          .i = a.i == b.i ? a.i : std::nullopt,
          .may_be_true = a.may_be_true || b.may_be_true,
          .may_be_false = a.may_be_false || b.may_be_false};
}

Value compare(Op op, const Enclosure& a, const Enclosure& b) {
  const bool numbers = has_numbers(a) && has_numbers(b);
  const bool nan = a.nan || b.nan;
  const bool same = numbers && a.lo == a.hi && b.lo == b.hi && a.lo == b.lo;
  const bool overlap = numbers && a.lo <= b.hi && b.lo <= a.hi;
  switch (op) {
    case Op::eq: return truth(overlap, nan || (numbers && !same));
    case Op::ne: return truth(nan || (numbers && !same), overlap);
    case Op::lt: return truth(numbers && a.lo < b.hi, nan || (numbers && a.hi >= b.lo));
    default: return truth(numbers && a.lo <= b.hi, nan || (numbers && a.hi > b.lo));
  }
}

class Run {
 public:
  Run(const Program& program, const std::vector<std::uint32_t>& inputs,
      const std::vector<std::uint32_t>& parameters, FloatRange range)
      : program_(program), inputs_(inputs), parameters_(parameters), range_(range) {
    outputs_.resize(program.outputs.size());
  }

  std::vector<Enclosure> outputs() {
    call(program_.entry(), {});
    return outputs_;
  }

 private:
  struct Activation {
    const Function& function;
    const std::vector<Value>& arguments;
    std::vector<Value> values;
    std::vector<Value> results;
  };

  std::vector<Value> call(const Function& function, const std::vector<Value>& arguments) {
    Activation frame{.function = function,
                     .arguments = arguments,
                     .values = std::vector<Value>(function.code.size()),
                     .results = std::vector<Value>(function.results.size())};
    // A literal stands wherever it was recorded, in a region that never runs too.
    for (std::size_t i = 0; i < function.code.size(); ++i) {
      if (function.code[i].op == Op::constant) step(frame, i, function.code[i]);
    }
    run(frame, 0, function.code.size());
    return std::move(frame.results);
  }

  void run(Activation& frame, std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const Instruction& instruction = frame.function.code[i];
      if (!opens_region(instruction.op)) {
        step(frame, i, instruction);
        continue;
      }
      const std::size_t close = region_end(frame.function, i);
      instruction.op == Op::if_any ? run_if(frame, i, close) : run_loop(frame, i, close);
      i = close;
    }
  }

  /// f(index) for the instructions of kind `op` of the region itself.
  template <class F>
  static void for_each_own(const Function& function, std::size_t open, std::size_t close, Op op,
                           F&& f) {
    int depth = 0;
    for (std::size_t k = open + 1; k < close; ++k) {
      if (opens_region(function.code[k].op)) ++depth;
      if (closes_region(function.code[k].op)) --depth;
      if (depth == 0 && function.code[k].op == op) f(k, function.code[k].operands);
    }
  }

  void run_if(Activation& frame, std::size_t open, std::size_t close) {
    auto& values = frame.values;
    const Value mask = values[frame.function.code[open].operands[0]];
    if (mask.may_be_true) run(frame, open + 1, close);
    for_each_own(frame.function, open, close, Op::merge, [&](std::size_t k, const auto& of) {
      values[k] = choose(mask, values[of[0]], values[of[1]]);
    });
  }

  void run_loop(Activation& frame, std::size_t open, std::size_t close) {
    const Function& function = frame.function;
    auto& values = frame.values;
    for_each_own(function, open, close, Op::carry,
                 [&](std::size_t k, const auto& of) { values[k] = values[of[0]]; });
    for_each_own(function, open, close, Op::next,
                 [&](std::size_t k, const auto& of) { values[k] = values[of[0]]; });
    Value active = values[function.code[open].operands[0]];
    for (std::uint32_t n = 0; active.may_be_true && n < function.code[open].imm; ++n) {
      if (active.may_be_false) {
        for_each_own(function, open, close, Op::next,
                     [&](std::size_t k, const auto&) { values[k] = open_value(); });
        return;
      }
      run(frame, open + 1, close);
      for_each_own(function, open, close, Op::next,
                   [&](std::size_t k, const auto& of) { values[k] = values[of[1]]; });
      for_each_own(function, open, close, Op::next,
                   [&](std::size_t k, const auto& of) { values[of[0]] = values[k]; });
      for_each_own(function, open, close, Op::again,
                   [&](std::size_t, const auto& of) { active = values[of[0]]; });
    }
  }

  static Value choose(const Value& mask, const Value& a, const Value& b) {
    if (mask.is_open()) return unite(a, b);
    return mask.may_be_true ? a : b;
  }

  static Value from_bits(Scalar type, std::uint32_t bits) {
    if (type == Scalar::b1) return truth(bits != 0, bits == 0);
    if (type == Scalar::i32) return integer(bits);
    return number(exactly(static_cast<double>(std::bit_cast<float>(flush_denormal(bits)))));
  }

  void step(Activation& frame, std::size_t i, const Instruction& instruction) {
    const auto operand = [&](std::size_t k) -> const Value& {
      return frame.values[instruction.operands[k]];
    };
    Value& to = frame.values[i];
    switch (instruction.op) {
      case Op::constant: to = from_bits(instruction.type, instruction.imm); break;
      case Op::parameter: to = from_bits(instruction.type, parameters_[instruction.imm]); break;
      case Op::input: to = from_bits(instruction.type, inputs_[instruction.imm]); break;
      case Op::argument: to = frame.arguments[instruction.imm]; break;
      case Op::select: to = choose(operand(0), operand(1), operand(2)); break;
      case Op::keep: to = operand(0); break;
      case Op::result: to = results_[instruction.imm]; break;
      case Op::give: frame.results[instruction.imm] = operand(0); break;
      case Op::call: call_function(frame, instruction); break;
      case Op::texture_call: results_.assign(4, open_value()); break;
      case Op::texel: to = open_value(); break;
      case Op::table: to = number(table(program_.tables[instruction.imm], operand(0).i)); break;
      case Op::store: outputs_[instruction.imm] = stored(instruction.imm, operand(0)); break;
      case Op::merge:
      case Op::carry:
      case Op::next:
      case Op::again: break;  // run_if and run_loop assign them.
      case Op::eq:
      case Op::ne:
      case Op::lt:
      case Op::le: to = compare(instruction.op, operand(0).f, operand(1).f); break;
      default: to = compute_or_convert(frame, instruction); break;
    }
  }

  void call_function(Activation& frame, const Instruction& instruction) {
    std::vector<Value> arguments;
    for (const ValueId id : frame.function.operands(instruction)) {
      arguments.push_back(frame.values[id]);
    }
    results_ = call(program_.functions[instruction.imm], arguments);
  }

  Enclosure stored(std::uint32_t channel, const Value& value) const {
    const Scalar type = program_.outputs[channel].type;
    if (type == Scalar::f32) return value.f;
    if (type == Scalar::i32) return value.i ? exactly(*value.i) : any;
    return {value.may_be_false ? 0.0 : 1.0, value.may_be_true ? 1.0 : 0.0, false};
  }

  static Enclosure table(const Table& table, const std::optional<std::uint32_t>& index) {
    const auto& values = table.values;
    if (index) {
      const auto last = static_cast<std::int32_t>(values.size()) - 1;
      const auto at = std::clamp(static_cast<std::int32_t>(*index), 0, last);
      return exactly(static_cast<double>(values[static_cast<std::size_t>(at)]));
    }
    const auto [low, high] = std::ranges::minmax(values);
    return {static_cast<double>(low), static_cast<double>(high), false};
  }

  Value compute_or_convert(const Activation& frame, const Instruction& instruction) const {
    const auto operand = [&](std::size_t k) {
      return k < instruction.count ? frame.values[instruction.operands[k]] : Value{};
    };
    const Value a = operand(0);
    switch (instruction.op) {
      case Op::f_to_i: return integer(truncated(a.f));
      case Op::bits: return integer(bits_of(a.f));
      case Op::i_to_f:
        return number(a.i ? rounded_once(static_cast<std::int32_t>(*a.i), range_) : any);
      case Op::u_to_f: return number(a.i ? rounded_once(*a.i, range_) : any);
      case Op::from_bits: return a.i ? from_bits(Scalar::f32, *a.i) : open_value();
      case Op::half_to_f: return a.i ? number(exactly(half(*a.i))) : open_value();
      default: break;
    }
    if (instruction.type == Scalar::f32) {
      return number(compute(instruction.op, a.f, operand(1).f, operand(2).f, range_));
    }
    return of_known(instruction, frame);
  }

  static double half(std::uint32_t bits) {
    return static_cast<double>(half_to_float(static_cast<std::uint16_t>(bits)));
  }

  /// Both ends the same integer: what every engine gets.
  static std::optional<std::uint32_t> truncated(const Enclosure& x) {
    const auto of = [](double value) {
      const auto clamped = std::clamp(value, -2147483648.0, 2147483647.0);
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(clamped));
    };
    if (!has_numbers(x)) return 0u;
    const bool agrees = of(x.lo) == of(x.hi) && (!x.nan || of(x.lo) == 0u);
    return agrees ? std::optional(of(x.lo)) : std::nullopt;
  }

  static std::optional<std::uint32_t> bits_of(const Enclosure& x) {
    if (!has_numbers(x)) return canonical_nan;
    const auto value = static_cast<float>(x.lo);
    // The sign of zero is open.
    if (!x.is_exact() || value == 0.0f || static_cast<double>(value) != x.lo) return std::nullopt;
    return std::bit_cast<std::uint32_t>(value);
  }

  /// An operation on integers and truth values: known where all its operands are, and
  /// where one truth value decides.
  static Value of_known(const Instruction& instruction, const Activation& frame) {
    std::array<std::uint32_t, 3> bits{};
    bool known = true;
    for (std::size_t k = 0; k < instruction.count; ++k) {
      const Value& value = frame.values[instruction.operands[k]];
      const bool is_truth = value.may_be_true || value.may_be_false;
      known = known && (is_truth ? !value.is_open() : value.i.has_value());
      bits[k] = is_truth ? value.may_be_true : value.i.value_or(0);
    }
    if (known) {
      const auto result = fold(instruction.op, std::span(bits).first(instruction.count));
      return from_bits(instruction.type, result.value_or(0));
    }
    return instruction.type == Scalar::b1 ? of_truths(instruction, frame) : integer({});
  }

  static Value of_truths(const Instruction& instruction, const Activation& frame) {
    if (instruction.op != Op::band && instruction.op != Op::bor) return truth(true, true);
    const Value& a = frame.values[instruction.operands[0]];
    const Value& b = frame.values[instruction.operands[1]];
    if (instruction.op == Op::band) {
      return truth(a.may_be_true && b.may_be_true, a.may_be_false || b.may_be_false);
    }
    return truth(a.may_be_true || b.may_be_true, a.may_be_false && b.may_be_false);
  }

  const Program& program_;
  const std::vector<std::uint32_t>& inputs_;
  const std::vector<std::uint32_t>& parameters_;
  FloatRange range_;
  std::vector<Enclosure> outputs_;
  std::vector<Value> results_;
};

}  // namespace

std::vector<Enclosure> enclose(const Program& program, const std::vector<std::uint32_t>& inputs,
                               const std::vector<std::uint32_t>& parameters, FloatRange range) {
  return Run(program, inputs, parameters, range).outputs();
}

}  // namespace nacre::testing
