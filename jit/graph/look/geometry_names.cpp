#include "jit/graph/look/geometry_names.h"

#include <algorithm>

#include "jit/document/value_text.h"

namespace nacre {

namespace {

constexpr std::size_t max_alternatives = 1024;

/// Splits at commas outside of braces.
std::vector<std::string_view> split_alternatives(std::string_view text) {
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '{') ++depth;
    if (i < text.size() && text[i] == '}') --depth;
    if (i < text.size() && (text[i] != ',' || depth > 0)) continue;
    parts.push_back(text.substr(first, i - first));
    first = i + 1;
  }
  return parts;
}

/// The brace that closes the one at `open`, or npos.
std::size_t closing_brace(std::string_view text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    if (text[i] == '{') ++depth;
    if (text[i] == '}' && --depth == 0) return i;
  }
  return std::string_view::npos;
}

/// Expressions without braces that together say the same; empty if there are too many.
std::vector<std::string> expand_braces(std::string_view expression) {
  std::vector<std::string> open{std::string(expression)};
  std::vector<std::string> done;
  while (!open.empty()) {
    const std::string text = std::move(open.back());
    open.pop_back();
    const std::size_t first = text.find('{');
    const std::size_t last =
        first == std::string::npos ? std::string::npos : closing_brace(text, first);
    if (last == std::string::npos) {
      done.push_back(text);
    } else {
      const std::string_view inside = std::string_view(text).substr(first + 1, last - first - 1);
      for (std::string_view part : split_alternatives(inside)) {
        open.push_back(text.substr(0, first) + std::string(trim(part)) + text.substr(last + 1));
      }
    }
    if (open.size() + done.size() > max_alternatives) return {};
  }
  return done;
}

/// One element of an expression without braces.
struct Token {
  enum class Kind { character, any, set, star, levels } kind;
  std::string_view text;  ///< The character, or the insides of a set.
};

std::vector<Token> tokens_of(std::string_view expression) {
  std::vector<Token> tokens;
  for (std::size_t i = 0; i < expression.size(); ++i) {
    const std::size_t close = expression[i] == '[' ? expression.find(']', i) : std::string::npos;
    if (expression.substr(i, 2) == "//") {
      tokens.push_back({Token::Kind::levels, {}});
      while (expression.substr(i + 1, 1) == "/") ++i;
    } else if (expression[i] == '*') {
      tokens.push_back({Token::Kind::star, {}});
    } else if (expression[i] == '?') {
      tokens.push_back({Token::Kind::any, {}});
    } else if (close != std::string::npos) {
      tokens.push_back({Token::Kind::set, expression.substr(i + 1, close - i - 1)});
      i = close;
    } else {
      tokens.push_back({Token::Kind::character, expression.substr(i, 1)});
    }
  }
  return tokens;
}

bool set_holds(std::string_view set, char c) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (i + 2 < set.size() && set[i + 1] == '-') {
      if (c >= set[i] && c <= set[i + 2]) return true;
      i += 2;
    } else if (set[i] == c) {
      return true;
    }
  }
  return false;
}

/// The ends that a token may have reached, of the places it may start at: both are
/// marks on the places between the characters of the name.
std::vector<bool> advance(const Token& token, std::string_view name,
                          const std::vector<bool>& starts) {
  std::vector<bool> ends(starts.size());
  bool running = false;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const bool more = i < name.size();
    switch (token.kind) {
      case Token::Kind::character:
        if (starts[i] && more && name[i] == token.text[0]) ends[i + 1] = true;
        break;
      case Token::Kind::any:
        if (starts[i] && more && name[i] != '/') ends[i + 1] = true;
        break;
      case Token::Kind::set:
        if (starts[i] && more && name[i] != '/' && set_holds(token.text, name[i])) {
          ends[i + 1] = true;
        }
        break;
      case Token::Kind::star:
        running = running || starts[i];
        if (running) ends[i] = true;
        if (more && name[i] == '/') running = false;
        break;
      case Token::Kind::levels:
        running = running || (starts[i] && more && name[i] == '/');
        if (running && more && name[i] == '/') ends[i + 1] = true;
        break;
    }
  }
  return ends;
}

bool glob_matches(std::string_view expression, std::string_view name) {
  std::vector<bool> at(name.size() + 1);
  at[0] = true;
  for (const Token& token : tokens_of(expression)) at = advance(token, name, at);
  return at.back();
}

std::string rooted(std::string_view name) {
  return name.starts_with('/') ? std::string(name) : '/' + std::string(name);
}

}  // namespace

std::vector<std::string_view> split_geom_list(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::string_view part : split_alternatives(text)) {
    part = trim(part);
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

std::string geom_list(const Element& element, std::string_view attribute) {
  const std::string_view prefix = element.inherited_attribute("geomprefix");
  std::string list;
  for (std::string_view name : split_geom_list(element.attribute(attribute))) {
    if (!list.empty()) list += ',';
    list += prefix;
    list += name;
  }
  return list;
}

bool geom_matches(std::string_view expression, std::string_view name, bool is_leaf) {
  if (expression.empty() || name.empty()) return false;
  const std::string full_name = rooted(name);
  for (const std::string& alternative : expand_braces(expression)) {
    std::string pattern = rooted(alternative);
    if (pattern.ends_with("//*") && !is_leaf) continue;
    while (pattern.size() > 1 && pattern.ends_with('/')) pattern.pop_back();
    if (glob_matches(pattern, full_name)) return true;
  }
  return false;
}

std::string_view parent_geom(std::string_view name) {
  if (name.size() <= 1) return {};
  const std::size_t slash = name.rfind('/');
  if (slash == std::string_view::npos) return {};
  return slash == 0 ? name.substr(0, 1) : name.substr(0, slash);
}

}  // namespace nacre
