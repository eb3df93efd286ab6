#include "jit/glsl/condition.h"

#include <charconv>
#include <string_view>

namespace nacre::glsl {

namespace {

constexpr int max_nesting = 64;

class Condition {
 public:
  explicit Condition(std::span<const Token> tokens) : tokens_(tokens) {}

  std::optional<long long> value() {
    const long long result = binary(0);
    return is_bad_ || at_ != tokens_.size() ? std::nullopt : std::optional(result);
  }

 private:
  bool take(std::string_view what) {
    if (at_ >= tokens_.size() || !tokens_[at_].is(what)) return false;
    ++at_;
    return true;
  }

  long long bad() {
    is_bad_ = true;
    at_ = tokens_.size();
    return 0;
  }

  // By precedence; more operators are not used in conditions.
  long long binary(int level) {
    if (level == 5) return unary(0);
    static constexpr std::string_view operators[5][4] = {
        {"||"}, {"&&"}, {"==", "!="}, {"<", ">", "<=", ">="}, {"+", "-"}};
    long long left = binary(level + 1);
    while (true) {
      std::string_view found;
      for (const std::string_view candidate : operators[level]) {
        if (!candidate.empty() && take(candidate)) found = candidate;
        if (!found.empty()) break;
      }
      if (found.empty()) return left;
      const long long right = binary(level + 1);
      if (found == "||") left = left != 0 || right != 0;
      if (found == "&&") left = left != 0 && right != 0;
      if (found == "==") left = left == right;
      if (found == "!=") left = left != right;
      if (found == "<") left = left < right;
      if (found == ">") left = left > right;
      if (found == "<=") left = left <= right;
      if (found == ">=") left = left >= right;
      if (found == "+") left += right;
      if (found == "-") left -= right;
    }
  }

  long long unary(int signs) {
    if (signs > max_nesting) return bad();
    if (take("!")) return unary(signs + 1) == 0 ? 1 : 0;
    if (take("-")) return -unary(signs + 1);
    if (take("(")) {
      if (++depth_ > max_nesting) return bad();
      const long long value = binary(0);
      --depth_;
      return take(")") ? value : bad();
    }
    if (at_ >= tokens_.size()) return bad();
    const Token& token = tokens_[at_++];
    if (token.kind == Token::Kind::name) return 0;  // Not defined.
    std::int32_t value = 0;
    const char* end = token.text.data() + token.text.size();
    const auto parsed = std::from_chars(token.text.data(), end, value);
    return parsed.ec == std::errc() && parsed.ptr == end ? value : bad();
  }

  std::span<const Token> tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
  bool is_bad_ = false;
};

}  // namespace

std::optional<long long> evaluate_condition(std::span<const Token> tokens) {
  return Condition(tokens).value();
}

}  // namespace nacre::glsl
