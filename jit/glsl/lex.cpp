#include <array>
#include <cctype>

#include "jit/glsl/token.h"
#include "runtime/report_stop.h"

namespace nacre::glsl {

namespace {

constexpr std::array<std::string_view, 24> long_operators{
    "<<=", ">>=", "++", "--", "<=", ">=", "==", "!=", "&&", "||", "^^", "+=",
    "-=",  "*=",  "/=", "%=", "&=", "|=", "^=", "<<", ">>", "##", "//", "/*"};
constexpr std::string_view short_operators = "+-*/%<>=!&|^~?:;,.(){}[]#";

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
}
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

class Lexer {
 public:
  Lexer(std::string_view text, std::uint32_t file) : text_(text) { place_ = {file, 1, 1}; }

  std::vector<Token> run() {
    std::vector<Token> tokens;
    while (true) {
      skip_blanks();
      Token token = next();
      token.starts_line = line_is_empty_;
      line_is_empty_ = false;
      tokens.push_back(token);
      if (token.kind == Token::Kind::end) return tokens;
    }
  }

 private:
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  void advance(std::size_t count = 1) {
    for (; count > 0 && at_ < text_.size(); --count, ++at_) {
      ++place_.column;
      if (text_[at_] != '\n') continue;
      ++place_.line;
      place_.column = 1;
      line_is_empty_ = true;
    }
  }

  void skip_blanks() {
    while (at_ < text_.size()) {
      if (peek() == '\\' && (peek(1) == '\n' || (peek(1) == '\r' && peek(2) == '\n'))) {
        // A joined line goes on where the one before ended.
        const bool was_empty = line_is_empty_;
        advance(peek(1) == '\n' ? 2 : 3);
        line_is_empty_ = was_empty;
      } else if (std::isspace(static_cast<unsigned char>(peek())) != 0) {
        advance();
      } else if (peek() == '/' && peek(1) == '/') {
        while (at_ < text_.size() && peek() != '\n') advance();
      } else if (peek() == '/' && peek(1) == '*') {
        const std::size_t end = text_.find("*/", at_ + 2);
        advance(end == std::string_view::npos ? text_.size() - at_ : end + 2 - at_);
      } else {
        return;
      }
    }
  }

  Token next() {
    Token token;
    token.place = place_;
    const std::size_t start = at_;
    if (at_ == text_.size()) return token;
    if (is_letter(peek())) {
      while (is_letter(peek()) || is_digit(peek())) advance();
      token.kind = Token::Kind::name;
    } else if (is_digit(peek()) || (peek() == '.' && is_digit(peek(1)))) {
      token.kind = number();
    } else if (peek() == '"') {
      return quoted(token);
    } else {
      token.kind = punctuation();
    }
    token.text = text_.substr(start, at_ - start);
    return token;
  }

  Token::Kind number() {
    if (peek() == '0' && (peek(1) == 'x' || peek(1) == 'X')) {
      advance(2);
      while (std::isxdigit(static_cast<unsigned char>(peek())) != 0) advance();
      return suffix(Token::Kind::integer);
    }
    Token::Kind kind = Token::Kind::integer;
    while (is_digit(peek())) advance();
    if (peek() == '.') {
      kind = Token::Kind::number;
      advance();
      while (is_digit(peek())) advance();
    }
    const bool has_sign = peek(1) == '+' || peek(1) == '-';
    if ((peek() == 'e' || peek() == 'E') && is_digit(peek(has_sign ? 2 : 1))) {
      kind = Token::Kind::number;
      advance(has_sign ? 2 : 1);
      while (is_digit(peek())) advance();
    }
    return suffix(kind);
  }

  Token::Kind suffix(Token::Kind kind) {
    if (kind == Token::Kind::integer && (peek() == 'u' || peek() == 'U')) {
      advance();
      return Token::Kind::natural;
    }
    if (peek() == 'f' || peek() == 'F') {
      advance();
      return Token::Kind::number;
    }
    return kind;
  }

  Token quoted(Token token) {
    advance();
    const std::size_t start = at_;
    while (at_ < text_.size() && peek() != '"' && peek() != '\n') advance();
    token.kind = Token::Kind::text;
    token.text = text_.substr(start, at_ - start);
    advance();
    return token;
  }

  Token::Kind punctuation() {
    for (const std::string_view candidate : long_operators) {
      if (text_.substr(at_, candidate.size()) == candidate) {
        advance(candidate.size());
        return Token::Kind::punctuation;
      }
    }
    const bool known = short_operators.find(peek()) != std::string_view::npos;
    advance();
    return known ? Token::Kind::punctuation : Token::Kind::unknown;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Place place_;
  bool line_is_empty_ = true;
};

}  // namespace

SourceLocation location(const Sources& sources, Place place) {
  const Sources::File& file = sources.file(place.file);
  return {file.name, place.line + file.first_line - 1, place.column, ""};
}

std::uint32_t Sources::add(File file) {
  files_.push_back(std::move(file));
  return count() - 1;
}

std::vector<Token> lex(const Sources& sources, std::uint32_t file) {
  return Lexer(sources.file(file).text, file).run();
}

void check_stop(const Stop& stop, const Sources& sources, Diagnostics& diagnostics, Place place) {
  if (report_if_due(stop, "reading the text", location(sources, place), diagnostics)) {
    throw Failure{};
  }
}

void fail(const Sources& sources, Diagnostics& diagnostics, Place place, std::string code,
          std::string message, std::string expected, std::string found) {
  diagnostics.error(std::move(code), location(sources, place), std::move(message),
                    std::move(expected), std::move(found));
  throw Failure{};
}

}  // namespace nacre::glsl
