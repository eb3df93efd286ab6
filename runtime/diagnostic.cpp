#include "runtime/diagnostic.h"

#include <fmt/format.h>

#include <utility>

namespace nacre {

namespace {

const char* name(Severity severity) {
  switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: return "error";
  }
  return "";
}

}  // namespace

std::string Diagnostic::to_string() const {
  std::string text;
  if (!where.file.empty()) {
    text += where.file;
    if (where.line > 0) text += fmt::format(":{}", where.line);
    text += ": ";
  }
  text += fmt::format("{}: {}", name(severity), message);
  if (!expected.empty()) text += fmt::format("; expected {}", expected);
  if (!found.empty()) text += fmt::format("{} found {}", expected.empty() ? ";" : ",", found);
  text += fmt::format(" [{}]", code);
  if (!where.path.empty()) text += fmt::format(" ({})", where.path);
  return text;
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::error) ++errors_;
  if (diagnostic.severity == Severity::warning) ++warnings_;
  all_.push_back(std::move(diagnostic));
}

void Diagnostics::error(std::string code, SourceLocation where, std::string message,
                        std::string expected, std::string found) {
  add({Severity::error, std::move(code), std::move(where), std::move(message),
       std::move(expected), std::move(found)});
}

void Diagnostics::warning(std::string code, SourceLocation where, std::string message,
                          std::string expected, std::string found) {
  add({Severity::warning, std::move(code), std::move(where), std::move(message),
       std::move(expected), std::move(found)});
}

std::string Diagnostics::to_string() const {
  std::string text;
  for (const Diagnostic& diagnostic : all_) {
    text += diagnostic.to_string();
    text += '\n';
  }
  return text;
}

}  // namespace nacre
