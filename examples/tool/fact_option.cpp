#include "examples/tool/fact_option.h"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <optional>
#include <string>

namespace nacre::tool {

namespace {

/// A float, as all that kernels read: 0.1 to 0.1 is one. Nothing where the text goes on behind it.
std::optional<double> number(const std::string& text) {
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0') return std::nullopt;
  return value;
}

/// Of "uv0=0,1" and "dot(N,wo)=0,1".
std::optional<Fact> parse(const std::string& text) {
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos) return std::nullopt;
  const std::string range = text.substr(equals + 1);
  const std::size_t comma = range.find(',');
  if (comma == std::string::npos) return std::nullopt;
  const auto low = number(range.substr(0, comma)), high = number(range.substr(comma + 1));
  if (!low || !high) return std::nullopt;
  return Fact{.name = text.substr(0, equals), .low = *low, .high = *high};
}

}  // namespace

void add_facts(CLI::App& command, std::vector<Fact>& facts) {
  command
      .add_option_function<std::vector<std::string>>(
          "--fact",
          [&facts](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) facts.push_back(*parse(text));
          },
          "What is known of numbers that kernels read, so that they leave out what cannot happen: "
          "the least and the greatest of a channel (uv0, uv0.x), a live parameter or a scalar "
          "product, \"dot(N,wo)\". Points of which it is not true are computed without")
      ->check(CLI::Validator(
          [](const std::string& text) {
            if (parse(text)) return std::string();
            return "expected NAME=MIN,MAX, found \"" + text.substr(0, 60) + '"';
          },
          ""))
      ->type_name("NAME=MIN,MAX")
      ->expected(1)
      ->take_all();
}

}  // namespace nacre::tool
