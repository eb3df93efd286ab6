#include "jit/llvm/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "runtime/program/once.h"
#include "runtime/program/region.h"

namespace nacre::codegen {

namespace {

/// Numbers of a row: more are not worth it.
constexpr std::uint32_t most_numbers = 256;
/// Places that values of one row lie apart: the two nodes of a look-up, and a few more.
constexpr std::uint32_t most_shift = 3;

constexpr std::uint32_t of_several = 1u << 31;

constexpr std::array row_ops{Op::add, Op::sub, Op::mul, Op::div, Op::fma,
                             Op::min, Op::max, Op::neg, Op::abs, Op::sqrt};

/// An i32 of an index: index * stride + offset + terms.
struct Linear {
  ValueId index = no_value;
  std::uint32_t stride = 1, offset = 0;
  std::vector<ValueId> terms;  ///< Once a call.
};

class Finder {
 public:
  Finder(const Function& entry, int lanes)
      : entry_(entry),
        once_(once_out_of_regions(entry)),
        lanes_(static_cast<std::uint32_t>(lanes)) {}

  Rows find() {
    result_.once = once_per_call(entry_);
    look_at_all();
    find_reads();
    if (!reads_.empty()) {
      make_rows();
      make_groups();
      find_what_only_groups_need();
      take_out_of_regions();
      weigh();
    }
    return std::move(result_);
  }

 private:
  struct Read {
    ValueId value;
    std::uint32_t base;    ///< The least offset of the tables' indices.
    std::uint32_t stride;  ///< Of all of them, or of_several: then no other is a place apart.
  };

  const Instruction& at(ValueId id) const { return entry_.code[id]; }
  bool is_constant(ValueId id) const { return at(id).op == Op::constant; }
  bool is_fixed(ValueId id) const { return once_[id] || is_constant(id); }

  /// What is known of a number, unless it is NaN; more than what stands before.
  enum class Sign { any, not_negative, plus };  ///< The second may be -0.

  /// Of what has been looked at before.
  Sign sign_of(ValueId id) const {
    const Instruction& instruction = at(id);
    const auto of = [&](std::size_t k) { return signs_[instruction.operands[k]]; };
    const auto both = [&](std::size_t a, std::size_t b) { return std::min(of(a), of(b)); };
    const auto is_above_0 = [&](std::size_t k) {
      const Instruction& operand = at(instruction.operands[k]);
      return operand.op == Op::constant && std::bit_cast<float>(operand.imm) > 0.0f;
    };
    // x + 0 is x, which may be -0.
    const auto sum = [&](Sign a, std::size_t k) {
      const Sign least = std::min(a, of(k));
      return least != Sign::any && is_above_0(k) ? Sign::plus : least;
    };
    switch (instruction.op) {
      case Op::constant: {
        const auto number = std::bit_cast<float>(instruction.imm);
        if (!(number >= 0.0f)) return Sign::any;
        return std::signbit(number) ? Sign::not_negative : Sign::plus;
      }
      case Op::abs: return Sign::plus;
      case Op::sqrt: return std::max(of(0), Sign::not_negative);
      case Op::floor: return of(0);
      case Op::max:
        if (is_above_0(0) || is_above_0(1)) return Sign::plus;
        // Of zeros either may be taken.
        return std::max(both(0, 1), std::min(std::max(of(0), of(1)), Sign::not_negative));
      case Op::min:
      case Op::mul: return both(0, 1);
      case Op::div: return of(1) == Sign::plus ? of(0) : Sign::any;
      case Op::add: return std::max(sum(of(0), 1), sum(of(1), 0));
      case Op::fma: return sum(both(0, 1), 2);
      case Op::select: return both(1, 2);
      case Op::merge: return both(0, 1);
      default: return Sign::any;
    }
  }

  /// The most that an index may be: it is no less than 0.
  std::optional<std::uint32_t> most_of_index(ValueId id) const {
    if (at(id).op != Op::f_to_i || !at(id).varying) return std::nullopt;
    const Instruction& place = at(at(id).operands[0]);
    if (place.op != Op::min) return std::nullopt;
    for (const std::size_t k : {0u, 1u}) {
      const Instruction& most = at(place.operands[k]);
      if (most.op != Op::constant || signs_[place.operands[1 - k]] == Sign::any) continue;
      const auto number = std::bit_cast<float>(most.imm);
      if (number >= 1.0f && number < static_cast<float>(most_numbers)) {
        return static_cast<std::uint32_t>(number);
      }
    }
    return std::nullopt;
  }

  std::optional<Linear> linear_of(ValueId id) const {
    const Instruction& instruction = at(id);
    if (most_of_index(id)) return Linear{.index = id, .terms = {}};
    if (instruction.op != Op::iadd && instruction.op != Op::imul) return std::nullopt;
    for (const std::size_t k : {0u, 1u}) {
      const ValueId fixed = instruction.operands[k];
      const std::optional<Linear>& known = linear_[instruction.operands[1 - k]];
      if (!known || !is_fixed(fixed)) continue;
      Linear sum = *known;
      if (instruction.op == Op::imul) {
        if (!is_constant(fixed) || !sum.terms.empty()) return std::nullopt;
        sum.stride *= at(fixed).imm;
        sum.offset *= at(fixed).imm;
      } else if (is_constant(fixed)) {
        sum.offset += at(fixed).imm;
      } else {
        sum.terms.insert(std::ranges::upper_bound(sum.terms, fixed), fixed);
      }
      return sum;
    }
    return std::nullopt;
  }

  /// The index that an f32 is of; no_value: it is of others too, or of none.
  ValueId index_of(ValueId id) const {
    const Instruction& instruction = at(id);
    if (!instruction.varying) return no_value;
    if (instruction.op == Op::table) {
      const std::optional<Linear>& place = linear_[instruction.operands[0]];
      return place ? place->index : no_value;
    }
    if (std::ranges::find(row_ops, instruction.op) == row_ops.end()) return no_value;
    ValueId index = no_value;
    for (const ValueId operand : entry_.operands(instruction)) {
      if (is_fixed(operand)) continue;
      if (index_[operand] == no_value) return no_value;
      if (index != no_value && index != index_[operand]) return no_value;
      index = index_[operand];
    }
    return index;
  }

  void look_at_all() {
    linear_.resize(entry_.code.size());
    index_.assign(entry_.code.size(), no_value);
    signs_.assign(entry_.code.size(), Sign::any);
    for (ValueId id = 0; id < entry_.code.size(); ++id) {
      if (at(id).type == Scalar::f32) signs_[id] = sign_of(id);
    }
    for (ValueId id = 0; id < entry_.code.size(); ++id) {
      if (!at(id).varying) continue;
      if (at(id).type == Scalar::i32) linear_[id] = linear_of(id);
      if (at(id).type == Scalar::f32) index_[id] = index_of(id);
    }
  }

  /// Values of one index that others than such values need.
  void find_reads() {
    std::set<ValueId> found;
    for (ValueId id = 0; id < entry_.code.size(); ++id) {
      for (const ValueId operand : entry_.operands(at(id))) {
        if (index_[operand] != no_value && index_[operand] != index_[id]) found.insert(operand);
      }
    }
    for (const ValueId id : found) {
      Read read{id, ~0u, 0};
      bool is_of_call = false;
      for (const ValueId step : steps_of({id})) look_at_step(step, read, is_of_call);
      // A table that is a row already is read where it is.
      if (is_of_call && read.stride != 0) reads_.push_back(read);
    }
  }

  void look_at_step(ValueId step, Read& read, bool& is_of_call) const {
    for (const ValueId operand : entry_.operands(at(step))) {
      is_of_call = is_of_call || once_[operand];
    }
    if (at(step).op != Op::table) return;
    const Linear& place = *linear_[at(step).operands[0]];
    read.base = std::min(read.base, place.offset);
    const bool is_other = read.stride != 0 && read.stride != place.stride;
    read.stride = is_other ? of_several : place.stride;
  }

  /// What differs by the index on the way to values of one index, in order.
  std::vector<ValueId> steps_of(const std::vector<ValueId>& values) const {
    std::set<ValueId> found;
    std::vector<ValueId> open = values;
    while (!open.empty()) {
      const ValueId id = open.back();
      open.pop_back();
      if (is_fixed(id) || most_of_index(id) || !found.insert(id).second) continue;
      const auto operands = entry_.operands(at(id));
      open.insert(open.end(), operands.begin(), operands.end());
    }
    return {found.begin(), found.end()};
  }

  /// A number for what is computed, by offsets from the least one: equal of equal rows.
  std::uint32_t form_of(ValueId id, std::uint32_t base) {
    if (const auto known = forms_.find({id, base}); known != forms_.end()) return known->second;
    const auto next = static_cast<std::uint32_t>(form_of_text_.size());
    const std::uint32_t form = form_of_text_.try_emplace(text_of(id, base), next).first->second;
    return forms_[{id, base}] = form;
  }
  /// By the forms of its operands: of what is used twice a text would be twice as long.
  std::string text_of(ValueId id, std::uint32_t base) {
    if (is_fixed(id)) return fmt::format("%{}", id);
    const Instruction& instruction = at(id);
    std::string text = fmt::format("({} {}", info(instruction.op).name, instruction.imm);
    if (instruction.op == Op::table) {
      const Linear& place = *linear_[instruction.operands[0]];
      text += fmt::format(" {}*{}+{}", place.index, place.stride, place.offset - base);
      for (const ValueId term : place.terms) text += fmt::format("+%{}", term);
    } else {
      for (const ValueId operand : entry_.operands(instruction)) {
        text += fmt::format(" #{}", form_of(operand, base));
      }
    }
    return text + ')';
  }

  void make_rows() {
    std::map<std::uint32_t, std::vector<Read>> alike;
    for (const Read& read : reads_) alike[form_of(read.value, read.base)].push_back(read);
    for (auto& [form, reads] : alike) {
      std::ranges::sort(reads, {}, &Read::base);
      std::vector<std::pair<std::uint32_t, std::uint32_t>> made;  // By base: rows.
      for (const Read& read : reads) {
        const auto places_from = [&](std::uint32_t base) {
          return (read.base - base) / read.stride;
        };
        const auto found = std::ranges::find_if(made, [&](const auto& row) {
          const std::uint32_t places = places_from(row.first);
          return places <= most_shift && read.base - row.first == places * read.stride;
        });
        std::uint32_t row = 0, shift = 0;
        if (found != made.end()) {
          row = found->second;
          shift = places_from(found->first);
        } else {
          row = static_cast<std::uint32_t>(result_.rows.size());
          made.emplace_back(read.base, row);
          result_.rows.push_back({read.value, index_[read.value], 0, steps_of({read.value})});
        }
        Row& read_from = result_.rows[row];
        const std::uint32_t nodes = *most_of_index(read_from.index) + 1;
        read_from.count = std::max(read_from.count, nodes + shift);
        row_of_[read.value] = {row, shift};
      }
    }
  }

  /// Reads of one index in one region stand together.
  void make_groups() {
    std::map<std::pair<ValueId, std::size_t>, std::vector<ValueId>> together;
    std::vector<std::size_t> regions{0};
    for (ValueId id = 0; id < entry_.code.size(); ++id) {
      if (opens_region(at(id).op)) regions.push_back(id);
      if (closes_region(at(id).op)) regions.pop_back();
      if (row_of_.contains(id)) together[{index_[id], regions.back()}].push_back(id);
    }
    for (const auto& [key, values] : together) {
      RowGroup group{.index = key.first, .reads = {}, .steps = steps_of(values)};
      for (const ValueId value : values) {
        const auto [row, shift] = row_of_.at(value);
        group.reads.push_back({value, row, shift});
      }
      result_.groups.emplace(values.front(), std::move(group));
    }
  }

  void find_what_only_groups_need() {
    std::vector<bool> is_step(entry_.code.size(), false), is_needed(entry_.code.size(), false);
    for (const auto& [first, group] : result_.groups) {
      for (const ValueId step : group.steps) is_step[step] = true;
    }
    for (std::size_t id = entry_.code.size(); id-- > 0;) {
      const bool is_read = row_of_.contains(static_cast<ValueId>(id));
      if (is_read || (is_step[id] && !is_needed[id])) continue;
      for (const ValueId operand : entry_.operands(entry_.code[id])) is_needed[operand] = true;
    }
    result_.is_in_group.assign(entry_.code.size(), false);
    for (ValueId id = 0; id < entry_.code.size(); ++id) {
      result_.is_in_group[id] = row_of_.contains(id) || (is_step[id] && !is_needed[id]);
    }
  }

  /// What rows are computed of is there before them.
  void take_out_of_regions() {
    std::vector<ValueId> open;
    for (const auto& [first, group] : result_.groups) {
      open.insert(open.end(), group.steps.begin(), group.steps.end());
    }
    while (!open.empty()) {
      const ValueId id = open.back();
      open.pop_back();
      for (const ValueId operand : entry_.operands(at(id))) {
        if (!once_[operand] || result_.once[operand]) continue;
        result_.once[operand] = true;
        open.push_back(operand);
      }
    }
  }

  void weigh() {
    std::uint64_t filling = 0, saved = 0;
    // Number by number, which is loads in the main: as many as code of all lanes has of them.
    for (const Row& row : result_.rows) filling += row.steps.size() * row.count;
    filling = (filling + lanes_ - 1) / lanes_;
    for (const auto& [first, group] : result_.groups) {
      saved += std::max(group.steps.size(), group.reads.size() + 1) - group.reads.size();
    }
    // Measured (AVX-512, begin of three live models, 64 to 2,048 points): with six times as many a
    // call that just has rows takes from a quarter less to 15 % more, and twice as large a one
    // less.
    result_.least_points = 6 * lanes_ * (filling / saved + 1);
  }

  const Function& entry_;
  const std::vector<bool> once_;
  const std::uint32_t lanes_;
  std::vector<std::optional<Linear>> linear_;
  std::vector<ValueId> index_;
  std::vector<Sign> signs_;
  std::vector<Read> reads_;
  std::map<std::pair<ValueId, std::uint32_t>, std::uint32_t> forms_;
  std::map<std::string, std::uint32_t> form_of_text_;
  std::map<ValueId, std::pair<std::uint32_t, std::uint32_t>> row_of_;  ///< And the shift.
  Rows result_;
};

}  // namespace

Rows find_rows(const Function& entry, int lanes) { return Finder(entry, lanes).find(); }

}  // namespace nacre::codegen
