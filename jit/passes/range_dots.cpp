#include "jit/passes/range_dots.h"

#include <algorithm>

#include "jit/passes/range_arithmetic.h"

namespace nacre {

std::optional<std::array<std::uint32_t, 3>> vector_inputs(const Program& program,
                                                          const std::string& name) {
  std::array<std::uint32_t, 3> numbers{};
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const Channel wanted{name + std::array{".x", ".y", ".z"}[i], Scalar::f32};
    const auto found = std::ranges::find(program.inputs, wanted);
    if (found == program.inputs.end()) return std::nullopt;
    numbers[i] = static_cast<std::uint32_t>(found - program.inputs.begin());
  }
  return numbers;
}

Dots::Dots(const Program& program, const Known& known)
    : code_(program.entry().code), terms_(code_.size()) {
  for (const DotRange& each : known.dots) {
    const auto a = vector_inputs(program, each.a), b = vector_inputs(program, each.b);
    if (!a || !b || known.inputs.empty()) continue;
    Dot dot{.terms = {}, .range = each.range};
    Range size{0, 0, false};
    for (std::size_t k = 0; k < dot.terms.size(); ++k) {
      dot.terms[k] = std::minmax((*a)[k], (*b)[k]);
      const Range& x = known.inputs[(*a)[k]];
      const Range& y = known.inputs[(*b)[k]];
      size = sum(size, product(absolute(x), absolute(y)));
    }
    // Of vectors of unknown length nothing is known of what is rounded.
    if (!size.is_bounded()) continue;
    std::ranges::sort(dot.terms);
    constexpr double rounding = 1e-6;  // A few units in the last place of what is summed.
    dot.range.low -= rounding * size.high;
    dot.range.high += rounding * size.high;
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
