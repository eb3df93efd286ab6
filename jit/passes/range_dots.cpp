#include "jit/passes/range_dots.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "jit/passes/range_arithmetic.h"

namespace nacre {

namespace {

std::optional<std::uint32_t> input_number(const Program& program, const std::string& name) {
  const auto found = std::ranges::find(program.inputs, name, &Channel::name);
  if (found == program.inputs.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - program.inputs.begin());
}

}  // namespace

Dots::Dots(const Program& program, const Known& known)
    : code_(program.entry().code), terms_(code_.size()) {
  for (const DotRange& each : known.dots) {
    Dot dot{.terms = {}, .range = each.range};
    double size = 0;
    std::size_t found = 0;
    for (const char* component : {".x", ".y", ".z"}) {
      const auto a = input_number(program, each.a + component);
      const auto b = input_number(program, each.b + component);
      if (!a || !b) break;
      dot.terms[found++] = std::minmax(*a, *b);
      // Of vectors of unknown length nothing is known of what is rounded.
      const bool is_bounded =
          !known.inputs.empty() && known.inputs[*a].is_bounded() && known.inputs[*b].is_bounded();
      size += is_bounded ? largest_size(known.inputs[*a]) * largest_size(known.inputs[*b])
                         : std::numeric_limits<double>::infinity();
    }
    if (found < dot.terms.size() || !std::isfinite(size)) continue;
    std::ranges::sort(dot.terms);
    constexpr double rounding = 1e-6;  // A few units in the last place of what is summed.
    dot.range.low -= rounding * size;
    dot.range.high += rounding * size;
    dots_.push_back(dot);
  }
}

Range Dots::look_at(ValueId value) {
  terms_[value] = terms_of(value);
  if (terms_[value].size() != 3) return {};
  Range range;
  for (const Dot& dot : dots_) {
    if (!std::ranges::equal(dot.terms, terms_[value])) continue;
    range = {std::max(range.low, dot.range.low), std::min(range.high, dot.range.high), false};
  }
  return range;
}

bool Dots::is_input(ValueId value) const { return code_[value].op == Op::input; }

std::vector<Dots::Term> Dots::terms_of(ValueId value) const {
  const Instruction& x = code_[value];
  std::vector<Term> terms;
  const auto add = [&](ValueId summed) {
    const std::vector<Term>& more = terms_[summed];
    terms.insert(terms.end(), more.begin(), more.end());
    return !more.empty();
  };
  bool is_sum = false;
  if (x.op == Op::mul || x.op == Op::fma) {
    if (!is_input(x.operands[0]) || !is_input(x.operands[1])) return {};
    terms.push_back(std::minmax(code_[x.operands[0]].imm, code_[x.operands[1]].imm));
    is_sum = x.op == Op::mul || add(x.operands[2]);
  } else if (x.op == Op::add) {
    is_sum = add(x.operands[0]) && add(x.operands[1]);
  }
  if (!is_sum || terms.size() > 3) return {};
  std::ranges::sort(terms);
  return terms;
}

}  // namespace nacre
