#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/diagnostic.h"
#include "runtime/stop.h"

namespace nacre::glsl {

/// The texts that tokens and syntax trees point into, by file. Never shrinks.
class Sources {
 public:
  Sources() = default;
  /// With the files of another, which keep their numbers and must not grow any more.
  explicit Sources(std::shared_ptr<const Sources> base)
      : base_(std::move(base)), base_count_(base_->count()) {}

  struct File {
    std::string name;
    std::string text;
    int first_line = 1;  ///< Where the text starts in the file of that name.
  };
  /// Keeps a file and returns its number.
  std::uint32_t add(File file);
  const File& file(std::uint32_t number) const {
    return number < base_count_ ? base_->file(number) : files_[number - base_count_];
  }
  std::uint32_t count() const { return base_count_ + static_cast<std::uint32_t>(files_.size()); }
  /// Keeps a text that is of no file.
  std::string_view intern(std::string text) { return kept_.emplace_back(std::move(text)); }

 private:
  std::shared_ptr<const Sources> base_;
  std::uint32_t base_count_ = 0;
  std::deque<File> files_;
  std::deque<std::string> kept_;
};

/// Where in a Sources something stands.
struct Place {
  std::uint32_t file = 0;
  int line = 0;
  int column = 0;
};

struct Token {
  enum class Kind : std::uint8_t {
    end,
    name,         ///< Also keywords, and the generators' "$token".
    integer,      ///< 12, 0xff
    natural,      ///< 12u
    number,       ///< 1.5, 1e-8, 1.f
    text,         ///< "file.glsl", in directives only; without the quotes.
    punctuation,  ///< The longest of the language's operators.
    unknown,      ///< A character that the language does not have.
  };
  Kind kind = Kind::end;
  bool starts_line = false;  ///< Nothing but blanks before it on its line.
  std::string_view text;
  Place place;

  bool is(std::string_view wanted) const {
    return (kind == Kind::punctuation || kind == Kind::name) && text == wanted;
  }
};

/// Splits a file of `sources` into tokens, comments and joined lines taken out.
/// The last one is `end`.
std::vector<Token> lex(const Sources& sources, std::uint32_t file);

/// Ends the reading or recording of a text: caught where a module is entered,
/// after the diagnostic was added. Never leaves this folder.
struct Failure {};

/// As diagnostics say it, without a path.
SourceLocation location(const Sources& sources, Place place);

/// Fails if `stop` is due.
void check_stop(const Stop& stop, const Sources& sources, Diagnostics& diagnostics, Place place);

/// Adds an error at a place and throws Failure.
[[noreturn]] void fail(const Sources& sources, Diagnostics& diagnostics, Place place,
                       std::string code, std::string message, std::string expected = {},
                       std::string found = {});

}  // namespace nacre::glsl
