#include "jit/document/value_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <vector>

namespace nacre {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// from_chars knows no leading '+'.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

// Where a number ended before its text did.
bool accept_rest(std::string_view text, const char* rest, bool* leftover) {
  if (rest == text.data() + text.size()) return true;
  if (leftover == nullptr || rest == text.data()) return false;
  // "1e" and "0x10" are no numbers with something behind them.
  if (*rest != '.') return false;
  *leftover = true;
  return true;
}

std::optional<float> parse_float(std::string_view text, bool* leftover) {
  text = without_plus(text);
  const char* end = text.data() + text.size();
  float number = 0;
  auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc::result_out_of_range) {
    // Too small is fine and rounds, too large is not.
    double wide = 0;
    const auto [wide_rest, wide_error] = std::from_chars(text.data(), end, wide);
    if (wide_error != std::errc{} || std::fabs(wide) > 1) return std::nullopt;
    number = static_cast<float>(wide);
    rest = wide_rest;
    error = wide_error;
  }
  if (error != std::errc{} || !std::isfinite(number)) return std::nullopt;
  if (!accept_rest(text, rest, leftover)) return std::nullopt;
  return number;
}

std::optional<std::int32_t> parse_integer(std::string_view text, bool* leftover) {
  text = without_plus(text);
  const char* end = text.data() + text.size();
  std::int32_t number = 0;
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || !accept_rest(text, rest, leftover)) return std::nullopt;
  return number;
}

// The next number of a list separated by commas or white space; false at a
// comma without a number before it.
bool next_token(std::string_view& text, std::string_view& token) {
  std::size_t size = 0;
  while (size < text.size() && text[size] != ',' && !is_space(text[size])) ++size;
  token = text.substr(0, size);
  text = trim(text.substr(size));
  if (text.starts_with(',')) {
    text = trim(text.substr(1));
    if (text.empty()) return false;
  }
  return !token.empty();
}

template <typename Number, typename Parse>
bool parse_list(std::string_view text, std::vector<Number>& numbers, Parse parse, bool* leftover) {
  text = trim(text);
  while (!text.empty()) {
    std::string_view token;
    if (!next_token(text, token)) return false;
    const std::optional<Number> number = parse(token, leftover);
    if (!number) return false;
    numbers.push_back(*number);
  }
  return true;
}

std::vector<std::string> split_strings(std::string_view text) {
  std::vector<std::string> result;
  if (trim(text).empty()) return result;
  std::string element;
  const auto finish = [&] {
    result.emplace_back(trim(element));
    element.clear();
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escapes = text[i] == '\\' && i + 1 < text.size() &&
                         (text[i + 1] == ',' || text[i + 1] == ';' || text[i + 1] == '\\');
    if (escapes) {
      element += text[++i];
    } else if (text[i] == ',') {
      finish();
    } else {
      element += text[i];
    }
  }
  finish();
  return result;
}

// Floats in one element of an array type; 0 for arrays of other things.
int floats_per_element(Type type) {
  switch (type) {
    case Type::float_array: return 1;
    case Type::vector2_array: return 2;
    case Type::color3_array:
    case Type::vector3_array: return 3;
    case Type::color4_array:
    case Type::vector4_array: return 4;
    default: return 0;
  }
}

bool parse_array(Type type, std::string_view text, Value& value, bool* leftover) {
  if (type == Type::integer_array) return parse_list(text, value.ints, parse_integer, leftover);
  if (const int each = floats_per_element(type)) {
    return parse_list(text, value.floats, parse_float, leftover) &&
           value.floats.size() % static_cast<std::size_t>(each) == 0;
  }
  value.texts = split_strings(text);
  return true;
}

bool parse_into(Type type, std::string_view text, Value& value, bool* leftover) {
  if (type == Type::boolean) {
    const std::string_view word = trim(text);
    value.ints = {word == "true"};
    return word == "true" || word == "false";
  }
  if (type == Type::integer) {
    return parse_list(text, value.ints, parse_integer, leftover) && value.ints.size() == 1;
  }
  if (is_numeric(type)) {
    const auto count = static_cast<std::size_t>(component_count(type));
    value.floats.reserve(count);
    return parse_list(text, value.floats, parse_float, leftover) && value.floats.size() == count;
  }
  if (is_array(type)) return parse_array(type, text, value, leftover);
  if (is_text(type)) {
    value.texts.emplace_back(text);
    return true;
  }
  return text.empty();
}

}  // namespace

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<Value> parse_value(Type type, std::string_view text, bool* leftover) {
  Value value;
  value.type = type;
  if (!parse_into(type, text, value, leftover)) return std::nullopt;
  return value;
}

std::string expected_text(Type type) {
  if (type == Type::boolean) return "true or false";
  if (type == Type::integer) return "one whole number";
  if (type == Type::float_) return "one number";
  if (is_numeric(type)) return fmt::format("{} numbers", component_count(type));
  if (type == Type::integer_array) return "whole numbers";
  if (const int each = floats_per_element(type); each > 1) {
    return fmt::format("a multiple of {} numbers", each);
  }
  if (type == Type::float_array) return "numbers";
  if (is_text(type) || is_array(type)) return "text";
  return "a connection";
}

Value zero_value(Type type) {
  Value value;
  value.type = type;
  if (type == Type::boolean || type == Type::integer) {
    value.ints = {0};
  } else if (is_numeric(type)) {
    value.floats.assign(static_cast<std::size_t>(component_count(type)), 0.0f);
    const std::size_t rows = type == Type::matrix33 ? 3 : type == Type::matrix44 ? 4 : 0;
    for (std::size_t i = 0; i < rows; ++i) value.floats[i * rows + i] = 1.0f;
  } else if (is_text(type)) {
    value.texts = {""};
  }
  return value;
}

}  // namespace nacre
