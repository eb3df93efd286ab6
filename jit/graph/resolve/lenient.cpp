#include "jit/graph/resolve/lenient.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "jit/document/value_text.h"

namespace nacre {

namespace {

bool is_tuple(Type type) {
  return is_numeric(type) && component_count(type) > 1 && type != Type::matrix33 &&
         type != Type::matrix44;
}

/// Numbers between commas and white space, each without an "f" or ";" behind it.
std::vector<std::string_view> split_numbers(std::string_view text) {
  constexpr std::string_view separators = ", \t\r\n";
  std::vector<std::string_view> numbers;
  while (true) {
    const std::size_t first = text.find_first_not_of(separators);
    if (first == std::string_view::npos) return numbers;
    text.remove_prefix(first);
    const std::size_t size = std::min(text.find_first_of(separators), text.size());
    std::string_view number = text.substr(0, size);
    const char last = number.back();
    if (number.size() > 1 && (last == 'f' || last == 'F' || last == ';')) number.remove_suffix(1);
    numbers.push_back(number);
    text.remove_prefix(size);
  }
}

}  // namespace

bool stands_for(Type from, Type to) {
  const auto pair = [&](Type a, Type b) {
    return (from == a && to == b) || (from == b && to == a);
  };
  if (pair(Type::color3, Type::vector3) || pair(Type::color4, Type::vector4)) return true;
  if (from == Type::integer && to == Type::float_) return true;
  return (from == Type::integer || from == Type::float_) && is_tuple(to);
}

Value as_type(const Value& value, Type to) {
  Value result;
  result.type = to;
  if (value.type == Type::integer || value.type == Type::float_) {
    const float number =
        value.type == Type::integer ? static_cast<float>(value.ints[0]) : value.floats[0];
    result.floats.assign(static_cast<std::size_t>(component_count(to)), number);
  } else {
    result.floats = value.floats;
  }
  return result;
}

std::optional<Value> parse_lenient(Type type, std::string_view text) {
  const bool is_list = type == Type::integer_array || type == Type::float_array;
  if (type == Type::boolean || (!is_numeric(type) && !is_list)) return std::nullopt;
  const std::vector<std::string_view> numbers = split_numbers(text);
  if (numbers.empty()) return std::nullopt;
  const bool takes_first = type == Type::integer || type == Type::float_;
  std::string joined;
  for (const std::string_view number : numbers) {
    // All have to be numbers, also those that are not wanted.
    const Type each =
        type == Type::integer || type == Type::integer_array ? Type::integer : Type::float_;
    bool leftover = false;
    if (!parse_value(each, number, &leftover)) return std::nullopt;
    if (joined.empty() || !takes_first) (joined += joined.empty() ? "" : ", ") += number;
  }
  bool leftover = false;
  return parse_value(type, joined, &leftover);
}

std::string lenient_reading(const Value& value) {
  if (!value.ints.empty()) return fmt::format("{} is used", fmt::join(value.ints, ", "));
  return fmt::format("{} is used", fmt::join(value.floats, ", "));
}

}  // namespace nacre
