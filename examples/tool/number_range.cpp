#include "examples/tool/number_range.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

namespace nacre::tool {

CLI::Validator number_within(double low, double high) {
  const std::string range = fmt::format("a number from {:g} to {:g}", low, high);
  const auto check = [low, high, range](const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool is_number = end != text.c_str() && *end == '\0';
    if (is_number && value >= low && value <= high) return std::string();
    return fmt::format("expected {}, found \"{}\"", range, text.substr(0, 60));
  };
  return CLI::Validator(check, "");
}

}  // namespace nacre::tool
