#include "jit/passes/range.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "jit/passes/range_arithmetic.h"
#include "jit/passes/range_dots.h"
#include "jit/passes/range_parts.h"
#include "jit/passes/range_zero.h"
#include "runtime/program/fold.h"
#include "runtime/program/region.h"

namespace nacre {

namespace {

/// What ranges over parts of an operand are worth it for.
bool is_arithmetic(Op op) {
  switch (op) {
    case Op::add:
    case Op::sub:
    case Op::mul:
    case Op::div:
    case Op::fma:
    case Op::min:
    case Op::max:
    case Op::sqrt:
    case Op::neg:
    case Op::abs: return true;
    default: return false;
  }
}

/// Of what may be left undone, so that large Programs take no longer than they are long: rounds of
/// loops, calls, parts.
class Effort {
 public:
  explicit Effort(std::size_t operations) : left_(operations) {}

  /// False where there is not so much left.
  bool spend(std::size_t operations) {
    if (operations > left_) return false;
    left_ -= operations;
    return true;
  }

 private:
  std::size_t left_;
};

/// The values of one function.
class Ranges {
 public:
  /// `given`: of inputs, or of arguments; `is_known`: they say something, and work is done for it.
  Ranges(const Program& program, std::size_t function, std::span<const Range> given, bool is_known,
         Effort& effort)
      : program_(program),
        function_(program.functions[function]),
        code_(function_.code),
        given_(given),
        is_known_(is_known),
        effort_(effort),
        list_(code_.size()),
        sources_(code_.size(), no_value) {
    if (is_known) ends_ = region_ends(function_);
    look_at_tables();
  }

  /// Of the entry, of which more is known.
  Ranges(const Program& program, const Known& known, Effort& effort)
      : Ranges(program, 0, known.inputs, true, effort) {
    parameters_ = known.parameters;
    use(known.arithmetic);
    if (!known.dots.empty()) dots_.emplace(program, known);
  }

  void use(Arithmetic arithmetic) {
    arithmetic_ = arithmetic;
    rounding_ = arithmetic == Arithmetic::as_written ? Rounding::to_nearest : Rounding::about;
  }

  std::vector<Range> run() {
    walk(0, code_.size());
    return std::move(list_);
  }

  /// What the function gives.
  std::vector<Range> results() {
    walk(0, code_.size());
    std::vector<Range> results(function_.results.size());
    for (const Instruction& x : code_) {
      if (x.op == Op::give) results[x.imm] = list_[x.operands[0]];
    }
    return results;
  }

 private:
  void walk(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if (is_known_ && code_[i].op == Op::loop) {
        walk_loop(i);
        i = ends_[i];
      } else {
        walk_one(static_cast<ValueId>(i));
      }
    }
  }

  void walk_one(ValueId id) {
    const Instruction& x = code_[id];
    if (is_known_ && x.op == Op::next) return;  // walk_loop's.
    if (is_known_ && x.op == Op::call) return walk_call(id);
    parts_.erase(id);
    Range range;
    if (is_known_ && x.op == Op::carry) {
      range = carried(id);
    } else if (x.type == Scalar::f32) {
      const OperandRanges operands = operands_of(x);
      range = of(x, operands);
      const bool is_given =
          x.op == Op::input || x.op == Op::parameter || x.op == Op::argument || x.op == Op::result;
      if (!is_given) range.minus_zero = !(range.low >= 0) || gives_minus_zero(x, operands);
    } else if (x.type == Scalar::i32 && is_known_) {
      range = of_integer(x, operands_of(x));
    }
    list_[id] = range;
    if (dots_) narrow(id, dots_->look_at(id));
    if (is_known_ && x.type == Scalar::f32) look_closer(id);
  }

  /// Tables are looked at once: some have tens of thousands of numbers.
  void look_at_tables() {
    std::vector<bool> is_known(program_.tables.size(), false);
    tables_.resize(program_.tables.size());
    for (const Instruction& x : code_) {
      if (x.op != Op::table || is_known[x.imm]) continue;
      tables_[x.imm] = of_table(program_.tables[x.imm]);
      is_known[x.imm] = true;
    }
  }

  /// Round by round: a lane that is active has been since the first.
  void walk_loop(std::size_t loop) {
    const std::size_t end = ends_[loop];
    std::vector<ValueId> ids;
    for (std::size_t i = loop + 1; i < end; i = after(i)) {
      if (code_[i].op == Op::next) ids.push_back(static_cast<ValueId>(i));
    }
    const std::uint32_t bound = loop_bound(code_[loop].imm);
    const bool is_too_long = !effort_.spend(bound * (end - loop));
    for (const ValueId id : ids) {
      const ValueId carry = code_[id].operands[0];
      if (is_too_long) {
        carried_[carry] = {};
      } else {
        carried_.erase(carry);
      }
    }
    std::vector<Range> seen, finals;
    for (std::uint32_t round = 0; round < (is_too_long ? 1 : bound); ++round) {
      walk(loop + 1, end);
      merge(seen, std::span(list_).subspan(loop + 1, end - loop - 1));
      std::vector<Range> values;
      for (const ValueId id : ids) values.push_back(list_[code_[id].operands[1]]);
      merge(finals, values);
      for (std::size_t k = 0; k < ids.size() && !is_too_long; ++k) {
        carried_[code_[ids[k]].operands[0]] = values[k];
      }
    }
    std::ranges::copy(seen, list_.begin() + static_cast<std::ptrdiff_t>(loop + 1));
    // Lanes that never were active have what was carried in.
    const bool all_active = is_true(code_[loop].operands[0]);
    for (std::size_t k = 0; k < ids.size() && bound > 0; ++k) {
      const Instruction& carry = code_[code_[ids[k]].operands[0]];
      list_[ids[k]] = all_active ? finals[k] : hull(finals[k], list_[carry.operands[0]]);
      sources_[ids[k]] = ids[k];
    }
  }

  /// The next instruction of the same region.
  std::size_t after(std::size_t i) const {
    return opens_region(code_[i].op) ? ends_[i] + 1 : i + 1;
  }

  bool is_true(ValueId id) const { return code_[id].op == Op::constant && code_[id].imm != 0; }

  /// What there was in earlier rounds, and what there is in this one.
  static void merge(std::vector<Range>& seen, std::span<const Range> now) {
    if (seen.empty()) {
      seen.assign(now.begin(), now.end());
      return;
    }
    for (std::size_t i = 0; i < now.size(); ++i) seen[i] = hull(seen[i], now[i]);
  }

  void walk_call(ValueId id) {
    results_.erase(id);
    if (!effort_.spend(program_.functions[code_[id].imm].code.size())) return;
    std::vector<Range> arguments;
    for (const ValueId operand : function_.operands(code_[id])) arguments.push_back(list_[operand]);
    Ranges callee(program_, code_[id].imm, arguments, true, effort_);
    callee.use(arithmetic_);
    results_[id] = callee.results();
  }

  OperandRanges operands_of(const Instruction& x) const {
    OperandRanges ranges;
    // `count` is no more than that, which GCC 12 does not know.
    const std::size_t count = std::min<std::size_t>(x.count, ranges.size());
    for (std::size_t k = 0; k < count; ++k) ranges[k] = list_[x.operands[k]];
    return ranges;
  }

  /// In the first round of a loop what comes in, then what the last one has left.
  Range carried(ValueId id) const {
    const auto known = carried_.find(id);
    return known != carried_.end() ? known->second : list_[code_[id].operands[0]];
  }

  Range of(const Instruction& x, const OperandRanges& in) const {
    switch (x.op) {
      case Op::constant: {
        const double value = std::bit_cast<float>(flush_denormal(x.imm));
        return std::isfinite(value) ? Range{value, value, false} : Range{};
      }
      case Op::input:
      case Op::argument: return given(x);
      case Op::parameter: return parameter(x);
      case Op::result: return result(x);
      case Op::floor: return is_known_ ? floored(in[0]) : Range{};
      case Op::add: return total(in[0], in[1]);
      case Op::sub: return difference(x, in);
      case Op::mul: return of_product(x, in);
      case Op::fma: return of_fma(x, in);
      case Op::div: return quotient(in[0], in[1], rounding_);
      case Op::min: return least(in[0], in[1]);
      case Op::max: return most(in[0], in[1]);
      case Op::sqrt: return root(in[0], rounding_);
      case Op::neg: return negated(in[0]);
      case Op::abs: return absolute(in[0]);
      case Op::select: return hull(in[1], in[2]);
      case Op::merge: return hull(in[0], in[1]);
      case Op::keep: return in[0];
      case Op::sin:
      case Op::cos: return {-1, 1, !in[0].is_bounded()};
      case Op::table: return tables_[x.imm];
      case Op::exp: return is_known_ ? exponential(in[0]) : Range{};
      case Op::i_to_f: return is_known_ ? of_signed(in[0]) : Range{};
      case Op::u_to_f: return is_known_ ? of_unsigned() : Range{};
      default: return {};
    }
  }

  Range of_integer(const Instruction& x, const OperandRanges& in) const {
    switch (x.op) {
      case Op::constant: {
        const auto value = static_cast<double>(std::bit_cast<std::int32_t>(x.imm));
        return {value, value, false};
      }
      case Op::input:
      case Op::argument: return given(x);
      case Op::parameter: return parameter(x);
      case Op::result: return result(x);
      case Op::f_to_i: return whole(in[0]);
      case Op::iadd: return integer_sum(in[0], in[1]);
      case Op::isub: return integer_sum(in[0], negated(in[1]));
      case Op::imul: return integer_product(in[0], in[1]);
      case Op::lshr: return integer_shift(in[0], in[1]);
      case Op::iand: return integer_and(in[0], in[1]);
      case Op::select: return hull(in[1], in[2]);
      case Op::merge: return hull(in[0], in[1]);
      default: return {};
    }
  }

  Range given(const Instruction& x) const {
    return x.imm < given_.size() ? given_[x.imm] : Range{};
  }
  Range parameter(const Instruction& x) const {
    return x.imm < parameters_.size() ? parameters_[x.imm] : Range{};
  }

  Range result(const Instruction& x) const {
    const auto call = results_.find(x.operands[0]);
    return call != results_.end() ? call->second[x.imm] : Range{};
  }

  /// Numbers that are known add up to one that is: so it stays the number of a tile.
  Range total(const Range& a, const Range& b) const {
    if (!is_known_ || !is_point(a) || !is_point(b)) return reassociated(sum(a, b, rounding_), a, b);
    const double exact = static_cast<float>(a.low + b.low);
    return std::isfinite(exact) ? Range{exact, exact, false} : Range{};
  }

  bool is_fraction(const Instruction& x) const {
    return x.op == Op::sub && code_[x.operands[1]].op == Op::floor &&
           code_[x.operands[1]].operands[0] == x.operands[0];
  }

  Range difference(const Instruction& x, const OperandRanges& in) const {
    const Range plain = total(in[0], negated(in[1]));
    return is_known_ && is_fraction(x) ? intersection(plain, fraction(in[0])) : plain;
  }

  Range of_product(const Instruction& x, const OperandRanges& in) const {
    return of_product(x, in, rounding_);
  }
  Range of_product(const Instruction& x, const OperandRanges& in, Rounding rounding) const {
    return is_known_ && x.operands[0] == x.operands[1] ? square(in[0], rounding)
                                                       : product(in[0], in[1], rounding);
  }

  /// A sum that may have been made of other parts, and rounds as they do.
  Range reassociated(Range total, const Range& a, const Range& b) const {
    if (arithmetic_ != Arithmetic::reassociated) return total;
    const double room = 1e-6 * (largest_size(a) + largest_size(b));
    if (!(room < std::numeric_limits<double>::infinity())) return {};
    total.low -= room, total.high += room;
    return total;
  }

  Range of_fma(const Instruction& x, const OperandRanges& in) const {
    const bool is_rounded_once = arithmetic_ == Arithmetic::as_written;
    const Range part = of_product(x, in, is_rounded_once ? Rounding::none : rounding_);
    const Range plain = reassociated(sum(part, in[2], rounding_), part, in[2]);
    if (!is_known_) return plain;
    const Instruction& rest = code_[x.operands[2]];
    const bool is_mixed = rest.op == Op::fma && rest.operands[1] == rest.operands[2] &&
                          code_[rest.operands[0]].op == Op::neg &&
                          code_[rest.operands[0]].operands[0] == x.operands[0];
    if (!is_mixed) return plain;
    const Range& from = list_[rest.operands[1]];
    const Range between = reassociated(mixed(from, in[1], in[0]), from, in[1]);
    return plain.is_bounded() ? intersection(plain, between) : between;
  }

  /// Remembers which other value it hangs on alone, and looks at parts of that where ways meet.
  void look_closer(ValueId id) {
    const Instruction& x = code_[id];
    sources_[id] = id;
    if (x.op == Op::constant) {
      sources_[id] = no_value;
      return;
    }
    if (!is_arithmetic(x.op) || is_fraction(x)) return;
    if (arithmetic_ == Arithmetic::reassociated) return;  // By no derivative.
    ValueId source = no_value;
    int ways = 0;
    for (std::size_t k = 0; k < x.count; ++k) {
      const ValueId each = sources_[x.operands[k]];
      if (each == no_value) continue;
      if (source != no_value && each != source) return;
      source = each;
      ++ways;
    }
    sources_[id] = source;
    const Range whole = source != no_value ? list_[source] : Range{};
    if (ways < 2 || !whole.is_bounded() || is_point(whole)) return;
    const std::vector<ValueId> cone = new_cone(id, source);
    if (!effort_.spend(cone.size() * part_count)) return;
    for (const ValueId each : cone) parts_[each] = {source, parts_of_value(each, source)};
    Range closer = parts_[id].second[0].value;
    for (const Part& each : parts_[id].second) closer = hull(closer, each.value);
    if (closer.is_bounded()) narrow(id, closer);
  }

  /// What else is known of it.
  void narrow(ValueId id, const Range& more) {
    const bool minus_zero = list_[id].minus_zero;
    list_[id] = intersection(list_[id], more);
    list_[id].minus_zero = minus_zero;
  }

  /// What a value is computed from, back to `source`, and whose parts are not known: in order.
  std::vector<ValueId> new_cone(ValueId id, ValueId source) const {
    std::set<ValueId> cone;
    std::vector<ValueId> open{id};
    while (!open.empty()) {
      const ValueId at = open.back();
      open.pop_back();
      const auto known = parts_.find(at);
      if ((known != parts_.end() && known->second.first == source) || !cone.insert(at).second) {
        continue;
      }
      for (std::size_t k = 0; at != source && k < code_[at].count; ++k) {
        const ValueId operand = code_[at].operands[k];
        if (sources_[operand] != no_value) open.push_back(operand);
      }
    }
    return {cone.begin(), cone.end()};
  }

  /// Where those of its operands are known.
  Parts parts_of_value(ValueId id, ValueId source) const {
    const Range& whole = list_[source];
    if (id == source) return nacre::parts_of(whole);
    const Instruction& x = code_[id];
    const double half = 0.5 * (whole.high - whole.low) / part_count;
    Parts parts;
    for (std::size_t p = 0; p < part_count; ++p) {
      std::array<Part, 3> operands;
      for (std::size_t k = 0; k < x.count; ++k) {
        const ValueId operand = x.operands[k];
        operands[k] = sources_[operand] == no_value ? constant_part(list_[operand])
                                                    : parts_.at(operand).second[p];
      }
      parts[p] = part_of(x, operands, half);
    }
    return parts;
  }

  Part part_of(const Instruction& x, const std::array<Part, 3>& in, double half) const {
    Part part;
    part.middle = of(x, {in[0].middle, in[1].middle, in[2].middle});
    part.slope = slope_of(x.op, in);
    const Range plain = of(x, {in[0].value, in[1].value, in[2].value});
    const Range closer = by_slope(part.middle, part.slope, half);
    part.value = closer.is_bounded() && plain.is_bounded() ? intersection(plain, closer) : plain;
    return part;
  }

  const Program& program_;
  const Function& function_;
  const std::vector<Instruction>& code_;
  const std::span<const Range> given_;
  std::span<const Range> parameters_;
  std::optional<Dots> dots_;
  Arithmetic arithmetic_ = Arithmetic::unknown;
  Rounding rounding_ = Rounding::about;
  const bool is_known_;
  Effort& effort_;
  std::vector<std::size_t> ends_;
  std::vector<Range> list_;
  /// What each hangs on alone, itself where there is no such other; no_value of constants.
  std::vector<ValueId> sources_;
  /// By value: of which source, and over its parts.
  std::map<ValueId, std::pair<ValueId, Parts>> parts_;
  std::vector<Range> tables_;                      ///< Those that are read, by table.
  std::map<ValueId, Range> carried_;               ///< Of loops, into the next round.
  std::map<ValueId, std::vector<Range>> results_;  ///< By call.
};

}  // namespace

std::vector<Range> ranges_of(const Program& program) {
  Effort none(0);
  return Ranges(program, 0, {}, false, none).run();
}

std::vector<Range> ranges_of(const Program& program, const Known& known) {
  Effort effort(known.effort);
  return Ranges(program, known, effort).run();
}

std::vector<Range> ranges_of(const Program& program, std::span<const Range> inputs) {
  return ranges_of(program,
                   Known{.inputs = {inputs.begin(), inputs.end()}, .parameters = {}, .dots = {}});
}

std::vector<Range> output_ranges(const Program& program, std::span<const Range> inputs) {
  return output_ranges(
      program, Known{.inputs = {inputs.begin(), inputs.end()}, .parameters = {}, .dots = {}});
}

std::vector<Range> output_ranges(const Program& program, const Known& known) {
  const std::vector<Range> all = ranges_of(program, known);
  std::vector<Range> outputs(program.outputs.size());
  const std::vector<Instruction>& code = program.entry().code;
  for (const Instruction& instruction : code) {
    if (instruction.op == Op::store) outputs[instruction.imm] = all[instruction.operands[0]];
  }
  return outputs;
}

}  // namespace nacre
