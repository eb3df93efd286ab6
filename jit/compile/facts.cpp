#include "jit/compile/facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "jit/passes/range_arithmetic.h"
#include "jit/passes/range_dots.h"
#include "runtime/channel/channel_name.h"
#include "runtime/channel/channel_table.h"
#include "runtime/program/recorder.h"
#include "runtime/program/transform.h"

namespace nacre {

namespace {

/// Of "dot(N,wo)" N and wo.
std::optional<std::pair<std::string, std::string>> factors_of(std::string_view name) {
  constexpr std::string_view opening = "dot(";
  if (!name.starts_with(opening) || !name.ends_with(')')) return std::nullopt;
  name.remove_prefix(opening.size());
  name.remove_suffix(1);
  const std::size_t comma = name.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string_view a = name.substr(0, comma), b = name.substr(comma + 1);
  if (a.empty() || b.empty() || b.find(',') != std::string_view::npos) return std::nullopt;
  return std::pair(std::string(a), std::string(b));
}

/// Whether a fact of that name is of a channel or slot.
bool is_of(std::string_view name, std::string_view leaf) {
  if (!leaf.starts_with(name)) return false;
  leaf.remove_prefix(name.size());
  // A component and nothing longer: "a" is of "a.x", not of "a/b.x".
  return leaf.empty() || (leaf.front() == '.' && leaf.find_first_of("./", 1) == leaf.npos);
}

/// The floats within: what is compared.
Range range_of(const Fact& fact) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  auto low = static_cast<float>(fact.low), high = static_cast<float>(fact.high);
  if (double(low) < fact.low) low = std::nextafter(low, infinity);
  if (double(high) > fact.high) high = std::nextafter(high, -infinity);
  // Denormals are zeros to kernels, which keep their signs.
  const auto seen = [](float x) {
    return std::abs(x) < std::numeric_limits<float>::min() ? std::copysign(0.0f, x) : x;
  };
  low = seen(low), high = seen(high);
  // From 0 on, by its sign too: so the sign of what is computed of it is known.
  return {low, high, false, !(low == 0.0f && !std::signbit(low))};
}

/// For all inputs or parameters that facts are of: act(number, type, range).
template <class Leaf, class Act>
void each_leaf(const std::vector<Leaf>& leaves, const Fact& fact, const Act& act) {
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const bool is_number = leaves[i].type == Scalar::f32 || leaves[i].type == Scalar::i32;
    if (is_number && is_of(fact.name, leaves[i].name)) {
      act(static_cast<std::uint32_t>(i), leaves[i].type, range_of(fact));
    }
  }
}

/// Records whether numbers are within ranges.
class Check {
 public:
  Check(Recorder& recorder, const Program& program) : recorder_(recorder), program_(program) {}

  void add(const Fact& fact) {
    if (const auto factors = factors_of(fact.name)) {
      const auto a = vector_inputs(program_, factors->first),
                 b = vector_inputs(program_, factors->second);
      if (a && b) compare(dot(*a, *b), Scalar::f32, range_of(fact));
      return;
    }
    each_leaf(program_.inputs, fact, [&](std::uint32_t i, Scalar type, const Range& range) {
      compare(leaf(Op::input, type, i), type, range);
    });
    each_leaf(program_.parameters, fact, [&](std::uint32_t i, Scalar type, const Range& range) {
      compare(leaf(Op::parameter, type, i), type, range);
    });
  }

  /// 0 where all are.
  Ref result() {
    const Ref is_outside = recorder_.emit(Op::bnot, std::array{are_within_});
    return recorder_.emit(Op::b_to_i, std::array{is_outside});
  }

 private:
  Ref leaf(Op op, Scalar type, std::uint32_t number) {
    return recorder_.adopted(bare_instruction(op, type, number));
  }
  Ref component(std::uint32_t input) { return leaf(Op::input, Scalar::f32, input); }

  Ref dot(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
    Ref sum = recorder_.emit(Op::mul, std::array{component(a[2]), component(b[2])});
    for (const std::size_t i : {std::size_t{1}, std::size_t{0}}) {
      sum = recorder_.emit(Op::fma, std::array{component(a[i]), component(b[i]), sum});
    }
    return sum;
  }

  void compare(Ref x, Scalar type, const Range& range) {
    if (type == Scalar::f32) {
      const Ref low = Ref::literal(static_cast<float>(range.low));
      const Ref high = Ref::literal(static_cast<float>(range.high));
      if (range.minus_zero) {
        demand(recorder_.emit(Op::le, std::array{low, x}));
      } else {
        const Ref bits = recorder_.emit(Op::bits, std::array{x});
        demand(recorder_.emit(Op::ilt, std::array{Ref::literal(std::int32_t{-1}), bits}));
      }
      demand(recorder_.emit(Op::le, std::array{x, high}));
      return;
    }
    const auto literal = [](double number) {
      const double whole = std::clamp(number, -0x1p31, 0x1p31 - 1);
      return Ref::literal(static_cast<std::int32_t>(whole));
    };
    const Ref low = literal(std::ceil(range.low)), high = literal(std::floor(range.high));
    const Ref below = recorder_.emit(Op::ilt, std::array{x, low});
    const Ref above = recorder_.emit(Op::ilt, std::array{high, x});
    demand(recorder_.emit(Op::bnot, std::array{recorder_.emit(Op::bor, std::array{below, above})}));
  }

  void demand(Ref is_so) { are_within_ = recorder_.emit(Op::band, std::array{are_within_, is_so}); }

  Recorder& recorder_;
  const Program& program_;
  Ref are_within_ = Ref::literal(true);
};

}  // namespace

std::string to_string(const Fact& fact) {
  return fmt::format("{} in [{}, {}]", fact.name, fact.low, fact.high);
}

bool check_facts(std::span<const Fact> facts, Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.error_count();
  for (const Fact& fact : facts) {
    // Rounded inwards there may be no float.
    const Range range = range_of(fact);
    const bool has_numbers = std::isfinite(fact.low) && std::isfinite(fact.high) &&
                             std::isfinite(range.low) && std::isfinite(range.high) &&
                             range.low <= range.high;
    if (!has_numbers) {
      diagnostics.error("bad-fact", {}, fmt::format("no number is in the fact '{}'", fact.name),
                        "floats that are finite, the smaller one first",
                        fmt::format("{} to {}", fact.low, fact.high));
    }
    const bool is_call = fact.name.find('(') != std::string::npos;
    if (fact.name.empty() || (is_call && !factors_of(fact.name))) {
      diagnostics.error("bad-fact", {}, "a fact is of nothing",
                        "a channel, a parameter, or dot(a,b) of two channels",
                        "'" + fact.name + "'");
    }
  }
  return diagnostics.error_count() == errors;
}

void warn_of_unread(std::span<const Fact> facts, std::span<const Program> programs,
                    Diagnostics& diagnostics) {
  const auto is_channel = [](std::string_view name) {
    return find_channel_group(parse_channel(name).group) != nullptr;
  };
  for (const Fact& fact : facts) {
    Diagnostics of_its_own;
    const auto factors = factors_of(fact.name);
    if (!check_facts({&fact, 1}, of_its_own)) continue;
    if (factors ? is_channel(factors->first) && is_channel(factors->second)
                : is_channel(fact.name)) {
      continue;
    }
    const auto reads = [&](const Program& program) {
      return !facts_of({&fact, 1}, program).empty();
    };
    if (std::ranges::any_of(programs, reads)) continue;
    diagnostics.warning("unread-fact", {}, "no kernel reads what a fact is of",
                        "a channel, a live parameter, or dot(a,b) of two channels",
                        "'" + fact.name + "'");
  }
}

std::vector<Fact> facts_of(std::span<const Fact> facts, const Program& program) {
  std::vector<Fact> parts;
  for (const Fact& fact : facts) {
    if (const auto factors = factors_of(fact.name)) {
      const bool is_read =
          vector_inputs(program, factors->first) && vector_inputs(program, factors->second);
      if (is_read) parts.push_back(fact);
      continue;
    }
    const auto add = [&](const auto& leaves) {
      each_leaf(leaves, fact, [&](std::uint32_t i, auto&&...) {
        parts.push_back({leaves[i].name, fact.low, fact.high, fact.is_implied});
      });
    };
    add(program.inputs);
    add(program.parameters);
  }
  return parts;
}

bool is_part_of(const Fact& part, const Fact& whole) {
  return part.low == whole.low && part.high == whole.high && is_of(whole.name, part.name);
}

double cost_of_check(const Fact& part, const Program& program) {
  if (part.is_implied) return 0;
  if (factors_of(part.name)) return 7;  // A sum of products, two comparisons, and both to others.
  // What is of the call is looked at once a call.
  const bool is_of_points =
      std::ranges::find(program.inputs, part.name, &Channel::name) != program.inputs.end();
  return is_of_points ? 4 : 0;
}

std::vector<Fact> facts_of_parameters(std::span<const Fact> facts, const Program& program) {
  std::vector<Fact> found;
  for (const Fact& fact : facts) {
    bool is_of_slot = false;
    each_leaf(program.parameters, fact, [&](auto&&...) { is_of_slot = true; });
    if (is_of_slot) found.push_back(fact);
  }
  return found;
}

Known known_by(std::span<const Fact> facts, const Program& program, Accuracy accuracy) {
  Known known{
      .inputs = std::vector<Range>(program.inputs.size()),
      .parameters = std::vector<Range>(program.parameters.size()),
      .dots = {},
      .arithmetic = accuracy == Accuracy::fast ? Arithmetic::reassociated : Arithmetic::as_written};
  // More effort takes long. Where nothing is stated it leaves out no more of the sample materials;
  // where something is, it may (bench/results/facts.md: open_pbr_carpaint).
  if (facts.empty()) known.effort = 3'000;
  const auto narrow = [](Range& range, const Range& more) {
    const bool minus_zero = range.minus_zero && more.minus_zero;
    range = intersection(range, more);
    range.minus_zero = minus_zero;
  };
  for (const Fact& fact : facts) {
    each_leaf(program.inputs, fact,
              [&](std::uint32_t i, Scalar, const Range& range) { narrow(known.inputs[i], range); });
    each_leaf(program.parameters, fact, [&](std::uint32_t i, Scalar, const Range& range) {
      narrow(known.parameters[i], range);
    });
    const auto factors = factors_of(fact.name);
    if (!factors) continue;
    const Range range = range_of(fact);
    known.dots.push_back({factors->first, factors->second, range});
    const auto vector = vector_inputs(program, factors->first);
    if (factors->first != factors->second || !vector || range.high < 0) continue;
    // No component is longer than the vector, but for squares that are denormal.
    const double least = std::numeric_limits<float>::min();
    const double longest = std::sqrt(std::max(range.high, least)) * (1 + 1e-6);
    for (const std::uint32_t i : *vector) narrow(known.inputs[i], {-longest, longest, false});
  }
  return known;
}

Program with_check(const Program& program, std::span<const Fact> facts, std::size_t most) {
  const auto same = [](Recorder&, const Instruction&, std::span<const Ref>) {
    return std::optional<Ref>();
  };
  const auto add_check = [&](Recorder& recorder) {
    Check check(recorder, program);
    for (const Fact& fact : facts) {
      if (!fact.is_implied) check.add(fact);
    }
    recorder.store(outside_facts_channel, check.result());
  };
  Program checked = transform(program, same, most, {}, add_check, true);
  mark_varying(checked);
  return checked;
}

}  // namespace nacre
