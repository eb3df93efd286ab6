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

CLI::Validator as_size() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        char* end = nullptr;
        const double number = std::strtod(text.c_str(), &end);
        const std::string asked = text.substr(0, 60);
        const auto wrong = [&] {
          return fmt::format("expected a number of bytes (64MB, 2GB), found \"{}\"", asked);
        };
        // AsSizeValue takes the sign for part of a huge number, and what is too large for one of
        // its own kind.
        if (end == text.c_str() || !(number >= 0.0 && number < 0x1p63)) return wrong();
        try {
          if (!CLI::AsSizeValue(false)(text).empty()) return wrong();
        } catch (const CLI::ValidationError&) {
          return wrong();
        }
        return std::strtod(text.c_str(), nullptr) < 0x1p63 ? std::string() : wrong();
      },
      "");
}

}  // namespace nacre::tool
