#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nacre {

/// Where in a document something was said. Empty fields are unknown.
struct SourceLocation {
  std::string file;  ///< As the user named it, or the resolved include.
  int line = 0;      ///< 1-based; 0: unknown.
  int column = 0;    ///< 1-based; 0: unknown.
  std::string path;  ///< Element path from the root: "NG_marble/mix1/fg".
};

/// An error leaves something undone or wrong; a warning says what was taken for granted.
enum class Severity { note, warning, error };

/// "note", "warning" or "error".
const char* severity_name(Severity severity);

/// One complaint about something the user gave us: a document, an image, a
/// flag. Our own faults are asserts, never diagnostics.
struct Diagnostic {
  Severity severity = Severity::error;  ///< How bad it is.
  std::string code;                     ///< Stable identifier, kebab-case: "unknown-node".
  /// Of what was wrong; empty where no place is known.
  SourceLocation where;
  std::string message;    ///< One sentence, no trailing stop.
  std::string expected;   ///< What would have been right; may be empty.
  std::string found;      ///< What was there; may be empty.
  std::string hint = {};  ///< What will have been meant (runtime/near_names.h); may be empty.

  /// "file:line:column: error: message; expected X, found Y; hint [code] (path)", on one line
  /// and printable whatever the document holds: see `printable`.
  std::string to_string() const;
};

/// Text from a document as a log may show it: control characters, which could begin a new
/// line or command a terminal, become `\xNN`, and what is longer than 400 bytes is cut.
std::string printable(std::string_view text);

/// Collects diagnostics. The library never prints: a host decides what to show.
class Diagnostics {
 public:
  static constexpr std::size_t most_kept = 10'000;  ///< Errors, and as many others.

  /// Puts it behind the others, and counts it.
  void add(Diagnostic diagnostic);
  /// Adds an error.
  void error(std::string code, SourceLocation where, std::string message, std::string expected = {},
             std::string found = {}, std::string hint = {});
  /// Adds a warning.
  void warning(std::string code, SourceLocation where, std::string message,
               std::string expected = {}, std::string found = {}, std::string hint = {});

  /// In the order they were found; no more than `most_kept` errors and as many others, so
  /// that a file of nothing but faults does not fill the memory. The counts go on.
  const std::vector<Diagnostic>& all() const { return all_; }
  /// Then what was asked for is not there, or not right.
  bool has_errors() const { return errors_ != 0; }
  /// Of all that were added, kept or not.
  std::size_t error_count() const { return errors_; }
  /// Of all that were added, kept or not.
  std::size_t warning_count() const { return warnings_; }

  /// All of them, one per line, in the order they were found.
  std::string to_string() const;

 private:
  std::vector<Diagnostic> all_;
  std::size_t errors_ = 0;
  std::size_t warnings_ = 0;
  std::size_t kept_errors_ = 0;
  std::size_t kept_others_ = 0;
};

}  // namespace nacre
