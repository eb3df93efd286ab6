#include "jit/graph/complaints.h"

#include <fmt/format.h>

#include <utility>

namespace nacre {

void Complaints::error(std::string code, const Element& element, std::string message,
                       std::string expected, std::string found, std::string hint) {
  diagnostics_.error(std::move(code), location(element), std::move(message), std::move(expected),
                     std::move(found), std::move(hint));
}

void Complaints::warning(std::string code, const Element& element, std::string message,
                         std::string expected, std::string found, std::string hint) {
  if (!is_new(code, element)) return;
  diagnostics_.warning(std::move(code), location(element), std::move(message), std::move(expected),
                       std::move(found), std::move(hint));
}

bool Complaints::tolerates(std::string code, const Element& element, const std::string& message,
                           std::string_view so, std::string expected, std::string found,
                           std::string hint) {
  if (!lenient_) {
    error(std::move(code), element, message, std::move(expected), std::move(found),
          std::move(hint));
    return false;
  }
  warning(std::move(code), element, fmt::format("{}, so {}", message, so), std::move(expected),
          std::move(found), std::move(hint));
  return true;
}

void Complaints::add(const Diagnostics& said, const Element& element) {
  for (const Diagnostic& one : said.all()) {
    if (one.severity == Severity::error || is_new(one.code, element)) diagnostics_.add(one);
  }
}

}  // namespace nacre
