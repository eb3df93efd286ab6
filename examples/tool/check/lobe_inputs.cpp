#include "examples/tool/check/lobe_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>

namespace nacre::tool {

namespace {

/// An input between whose ends there is something to choose: two numbers a component.
struct Range {
  const NodeDefInput* input;
  std::vector<double> low, high;
  std::size_t choices = 0;  ///< Of a string; else it has numbers.
};

std::vector<double> numbers_of(const Value& value) {
  std::vector<double> numbers(value.floats.begin(), value.floats.end());
  numbers.insert(numbers.end(), value.ints.begin(), value.ints.end());
  return numbers;
}

/// `weight` is the kernel's business, and frames are those of the point.
bool is_varied(const NodeDefInput& input) {
  return input.name != "weight" && input.defaultgeomprop.empty() &&
         input.member.struct_type.empty();
}

std::optional<Range> range_of(const NodeDefInput& input) {
  if (!is_varied(input)) return std::nullopt;
  Range range{&input, {}, {}};
  if (input.type == Type::string && !input.enums.empty()) {
    range.choices = input.enums.size();
    return range;
  }
  if (input.type == Type::boolean) return Range{&input, {0}, {1}};
  const InputUi ui = ui_of(input);
  range.low = numbers_of(ui.min.type != Type::none ? ui.min : ui.soft_min);
  range.high = numbers_of(ui.max.type != Type::none ? ui.max : ui.soft_max);
  const auto count = static_cast<std::size_t>(component_count(input.type));
  const bool is_color = input.type == Type::color3 || input.type == Type::color4;
  if (is_color && range.low.empty()) range.low.assign(count, 0.0);
  if (is_color && range.high.empty()) range.high.assign(count, 1.0);
  const bool is_whole = count > 0 && range.low.size() == count && range.high.size() == count;
  return is_whole ? std::optional(range) : std::nullopt;
}

/// A share of the way from the low end to the high one.
using Share = std::function<double()>;

LobeInput chosen(const Range& range, const Share& share) {
  const NodeDefInput& input = *range.input;
  LobeInput made{std::string(input.name), std::string(input.type_text), {}};
  if (range.choices > 0) {
    const auto last = static_cast<double>(range.choices - 1);
    made.value = input.enums[static_cast<std::size_t>(std::lround(last * share()))];
    return made;
  }
  for (std::size_t i = 0; i < range.low.size(); ++i) {
    double number = range.low[i] + (range.high[i] - range.low[i]) * share();
    if (input.type == Type::boolean) {
      made.value = number < 0.5 ? "false" : "true";
      continue;
    }
    if (input.type == Type::integer) number = std::round(number);
    made.value += fmt::format("{}{}", i == 0 ? "" : ", ", static_cast<float>(number));
  }
  return made;
}

}  // namespace

std::vector<std::vector<LobeInput>> lobe_inputs(const NodeDef& def, std::size_t count) {
  std::vector<Range> ranges;
  for (const NodeDefInput& input : def.inputs) {
    if (const auto range = range_of(input)) ranges.push_back(*range);
  }
  std::mt19937_64 random(1);
  const auto drawn = [&] {
    const auto number = static_cast<double>(random() >> 58);  // 0 .. 63.
    return std::clamp((number - 16) / 31, 0.0, 1.0);
  };
  std::vector<std::vector<LobeInput>> sets(1);
  while (sets.size() < count && !ranges.empty()) {
    const Share share = sets.size() == 1   ? Share([] { return 0.0; })
                        : sets.size() == 2 ? Share([] { return 1.0; })
                                           : Share(drawn);
    std::vector<LobeInput> set;
    for (const Range& range : ranges) set.push_back(chosen(range, share));
    sets.push_back(std::move(set));
  }
  return sets;
}

std::vector<std::string> inputs_without_range(const NodeDef& def) {
  std::vector<std::string> names;
  for (const NodeDefInput& input : def.inputs) {
    if (is_numeric(input.type) && is_varied(input) && !range_of(input)) {
      names.emplace_back(input.name);
    }
  }
  return names;
}

std::string to_string(const std::vector<LobeInput>& inputs) {
  std::string text;
  for (const LobeInput& input : inputs) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", input.name, input.value);
  }
  return text.empty() ? "defaults" : text;
}

}  // namespace nacre::tool
