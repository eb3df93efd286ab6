#include "jit/passes/range.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "runtime/program/fold.h"

namespace nacre {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Larger than what rounding to float moves a number by, in parts of it.
constexpr double rounding = 1e-6;

/// Wider by what floats round, which makes zero of what is denormal; nothing is known of what
/// leaves their range.
Range rounded(double low, double high) {
  constexpr double largest = 1e38, smallest = 1.2e-38;
  if (!(low >= -largest && high <= largest)) return {};
  low -= rounding * std::abs(low);
  high += rounding * std::abs(high);
  return {low > 0 && low < smallest ? 0 : low, high < 0 && high > -smallest ? 0 : high, false};
}

Range hull(const Range& a, const Range& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high), a.nan || b.nan};
}

Range sum(const Range& a, const Range& b) {
  if (!a.is_bounded() || !b.is_bounded()) return {};
  return rounded(a.low + b.low, a.high + b.high);
}

Range negated(const Range& a) { return {-a.high, -a.low, a.nan}; }

Range product(const Range& a, const Range& b) {
  if (!a.is_bounded() || !b.is_bounded()) return {};
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return rounded(low, high);
}

Range quotient(const Range& a, const Range& b) {
  if (!a.is_bounded() || !b.is_bounded() || (b.low <= 0 && b.high >= 0)) return {};
  const auto [low, high] =
      std::minmax({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
  return rounded(low, high);
}

/// a < b ? a : b: of NaN the second.
Range least(const Range& a, const Range& b) {
  return {std::min(a.low, b.low), a.nan ? b.high : std::min(a.high, b.high), b.nan};
}
Range most(const Range& a, const Range& b) {
  return {a.nan ? b.low : std::max(a.low, b.low), std::max(a.high, b.high), b.nan};
}

Range absolute(const Range& a) {
  const double high = std::max(std::abs(a.low), std::abs(a.high));
  const bool has_zero = a.low <= 0 && a.high >= 0;
  return {has_zero ? 0.0 : std::min(std::abs(a.low), std::abs(a.high)), high, a.nan};
}

Range root(const Range& a) {
  if (!a.is_bounded() || a.low < 0) return {0, infinity, true};
  return rounded(std::sqrt(a.low), std::sqrt(a.high));
}

Range of_table(const Table& table) {
  const auto [low, high] = std::ranges::minmax(table.values);
  return std::isfinite(low) && std::isfinite(high) ? rounded(low, high) : Range{};
}

bool is_point(const Range& a) { return a.is_bounded() && a.low == a.high; }

Range floored(const Range& a) {
  return a.is_bounded() ? Range{std::floor(a.low), std::floor(a.high), false} : Range{};
}

/// Of x - floor(x), which rounds to 1 just below a whole number.
Range fraction(const Range& x) { return x.is_bounded() ? Range{0, 1, false} : Range{}; }

/// Of Op::exp, whose kernels need not round right.
Range exponential(const Range& a) {
  if (!a.is_bounded()) return {};
  const Range exact = rounded(std::exp(a.low), std::exp(a.high));
  return exact.is_bounded() ? rounded(exact.low, exact.high) : exact;
}

Range intersection(const Range& a, const Range& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high), a.nan && b.nan};
}

/// Of Op::f_to_i.
Range whole(const Range& a) {
  return a.is_bounded() ? Range{std::trunc(a.low), std::trunc(a.high), false} : Range{};
}

/// Of integers, which wrap around: nothing is known of what may.
Range integers(double low, double high) {
  return low >= -0x1p31 && high < 0x1p31 ? Range{low, high, false} : Range{};
}

Range integer_sum(const Range& a, const Range& b) {
  return a.is_bounded() && b.is_bounded() ? integers(a.low + b.low, a.high + b.high) : Range{};
}

Range integer_product(const Range& a, const Range& b) {
  if (!a.is_bounded() || !b.is_bounded()) return {};
  const auto [low, high] =
      std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return integers(low, high);
}

class Ranges {
 public:
  explicit Ranges(const Program& program, std::span<const Range> inputs = {})
      : program_(program), inputs_(inputs) {
    for (const Table& table : program.tables) tables_.push_back(of_table(table));
  }

  std::vector<Range> run() {
    for (const Instruction& instruction : program_.entry().code) {
      Range range;
      if (instruction.type == Scalar::f32) range = of(instruction);
      if (instruction.type == Scalar::i32 && !inputs_.empty()) range = of_integer(instruction);
      list_.push_back(range);
    }
    return std::move(list_);
  }

 private:
  Range at(const Instruction& instruction, std::size_t operand) const {
    return list_[instruction.operands[operand]];
  }

  Range of(const Instruction& x) const {
    switch (x.op) {
      case Op::constant: {
        const double value = std::bit_cast<float>(flush_denormal(x.imm));
        return std::isfinite(value) ? Range{value, value, false} : Range{};
      }
      case Op::input: return inputs_.empty() ? Range{} : inputs_[x.imm];
      case Op::floor: return inputs_.empty() ? Range{} : floored(at(x, 0));
      case Op::add: return total(at(x, 0), at(x, 1));
      case Op::sub: return difference(x);
      case Op::mul: return of_product(x);
      case Op::fma: return sum(product(at(x, 0), at(x, 1)), at(x, 2));
      case Op::div: return quotient(at(x, 0), at(x, 1));
      case Op::min: return least(at(x, 0), at(x, 1));
      case Op::max: return most(at(x, 0), at(x, 1));
      case Op::sqrt: return root(at(x, 0));
      case Op::neg: return negated(at(x, 0));
      case Op::abs: return absolute(at(x, 0));
      case Op::select: return hull(at(x, 1), at(x, 2));
      case Op::merge: return hull(at(x, 0), at(x, 1));
      case Op::keep: return at(x, 0);
      case Op::sin:
      case Op::cos: return {-1, 1, !at(x, 0).is_bounded()};
      case Op::table: return tables_[x.imm];
      case Op::exp: return inputs_.empty() ? Range{} : exponential(at(x, 0));
      case Op::i_to_f: return inputs_.empty() ? Range{} : of_whole(at(x, 0));
      case Op::u_to_f: return inputs_.empty() ? Range{} : rounded(0, 0x1p32);
      default: return {};
    }
  }

  Range difference(const Instruction& x) const {
    const Range plain = total(at(x, 0), negated(at(x, 1)));
    const Instruction& floor = program_.entry().code[x.operands[1]];
    const bool is_fraction = floor.op == Op::floor && floor.operands[0] == x.operands[0];
    if (inputs_.empty() || !is_fraction) return plain;
    return intersection(plain, fraction(at(x, 0)));
  }

  Range of_product(const Instruction& x) const {
    const Range plain = product(at(x, 0), at(x, 1));
    if (inputs_.empty() || x.operands[0] != x.operands[1] || !plain.is_bounded()) return plain;
    return {std::max(plain.low, 0.0), plain.high, false};
  }

  /// Of an i32 as a float.
  static Range of_whole(const Range& a) {
    return a.is_bounded() ? rounded(a.low, a.high) : rounded(-0x1p31, 0x1p31);
  }

  /// Numbers that are known add up to one that is: so it stays the number of a tile.
  Range total(const Range& a, const Range& b) const {
    if (inputs_.empty() || !is_point(a) || !is_point(b)) return sum(a, b);
    const double exact = static_cast<float>(a.low + b.low);
    return std::isfinite(exact) ? Range{exact, exact, false} : Range{};
  }

  Range of_integer(const Instruction& x) const {
    switch (x.op) {
      case Op::constant: {
        const auto value = static_cast<double>(std::bit_cast<std::int32_t>(x.imm));
        return {value, value, false};
      }
      case Op::f_to_i: return whole(at(x, 0));
      case Op::iadd: return integer_sum(at(x, 0), at(x, 1));
      case Op::isub: return integer_sum(at(x, 0), negated(at(x, 1)));
      case Op::imul: return integer_product(at(x, 0), at(x, 1));
      case Op::select: return hull(at(x, 1), at(x, 2));
      case Op::merge: return hull(at(x, 0), at(x, 1));
      default: return {};
    }
  }

  const Program& program_;
  std::span<const Range> inputs_;
  std::vector<Range> tables_;
  std::vector<Range> list_;
};

}  // namespace

bool Range::is_bounded() const { return !nan && low > -infinity && high < infinity; }

std::vector<Range> ranges_of(const Program& program) { return Ranges(program).run(); }

std::vector<Range> ranges_of(const Program& program, std::span<const Range> inputs) {
  return Ranges(program, inputs).run();
}

std::vector<Range> output_ranges(const Program& program, std::span<const Range> inputs) {
  const std::vector<Range> all = ranges_of(program, inputs);
  std::vector<Range> outputs(program.outputs.size());
  const std::vector<Instruction>& code = program.entry().code;
  for (const Instruction& instruction : code) {
    if (instruction.op == Op::store) outputs[instruction.imm] = all[instruction.operands[0]];
  }
  return outputs;
}

}  // namespace nacre
