#include "runtime/diagnostic.h"

#include <fmt/format.h>

#include <utility>

namespace nacre {

const char* severity_name(Severity severity) {
  switch (severity) {
    case Severity::note: return "note";
    case Severity::warning: return "warning";
    case Severity::error: return "error";
  }
  return "";
}

std::string Diagnostic::to_string() const {
  std::string text;
  if (!where.file.empty()) {
    text += printable(where.file);
    if (where.line > 0) text += fmt::format(":{}", where.line);
    if (where.line > 0 && where.column > 0) text += fmt::format(":{}", where.column);
    text += ": ";
  }
  text += fmt::format("{}: {}", severity_name(severity), printable(message));
  if (!expected.empty()) text += fmt::format("; expected {}", printable(expected));
  if (!found.empty()) {
    text += fmt::format("{} found {}", expected.empty() ? ";" : ",", printable(found));
  }
  if (!hint.empty()) text += fmt::format("; {}", printable(hint));
  text += fmt::format(" [{}]", code);
  if (!where.path.empty()) text += fmt::format(" ({})", printable(where.path));
  return text;
}

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 400;
  const std::size_t size = text.size();
  if (size > longest) {
    std::size_t cut = longest;
    while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80) --cut;
    text = text.substr(0, cut);
  }
  std::string result;
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) {
      result += fmt::format("\\x{:02X}", byte);
    } else {
      result += c;
    }
  }
  if (text.size() < size) result += fmt::format("... ({} bytes)", size);
  return result;
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::error) ++errors_;
  if (diagnostic.severity == Severity::warning) ++warnings_;
  const bool is_error = diagnostic.severity == Severity::error;
  std::size_t& kept = is_error ? kept_errors_ : kept_others_;
  if (kept == most_kept) return;
  ++kept;
  all_.push_back(std::move(diagnostic));
}

void Diagnostics::error(std::string code, SourceLocation where, std::string message,
                        std::string expected, std::string found, std::string hint) {
  add({Severity::error, std::move(code), std::move(where), std::move(message), std::move(expected),
       std::move(found), std::move(hint)});
}

void Diagnostics::warning(std::string code, SourceLocation where, std::string message,
                          std::string expected, std::string found, std::string hint) {
  add({Severity::warning, std::move(code), std::move(where), std::move(message),
       std::move(expected), std::move(found), std::move(hint)});
}

std::string Diagnostics::to_string() const {
  std::string text;
  for (const Diagnostic& diagnostic : all_) {
    text += diagnostic.to_string();
    text += '\n';
  }
  if (errors_ > kept_errors_)
    text += fmt::format("... and {} more errors\n", errors_ - kept_errors_);
  if (warnings_ > kept_others_) text += "... and more warnings\n";
  return text;
}

}  // namespace nacre
