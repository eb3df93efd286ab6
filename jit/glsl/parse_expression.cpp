// Expressions: the parser's third part.
#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <iterator>

#include "jit/glsl/parser.h"

namespace nacre::glsl {

namespace {

// Binary operators, the loosest first.
constexpr std::string_view binary_operators[][4] = {
    {"||"},       {"^^"},     {"&&"},         {"|"},
    {"^"},        {"&"},      {"==", "!="},   {"<", ">", "<=", ">="},
    {"<<", ">>"}, {"+", "-"}, {"*", "/", "%"}};

/// How tightly a token binds as a binary operator; -1 if it is none.
int precedence_of(const Token& token) {
  if (token.kind != Token::Kind::punctuation || token.text.empty()) return -1;
  for (std::size_t level = 0; level < std::size(binary_operators); ++level) {
    if (contains(binary_operators[level], token.text)) return static_cast<int>(level);
  }
  return -1;
}

constexpr std::string_view assignments[] = {
    "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="};

}  // namespace

Expression::~Expression() {
  std::vector<ExpressionPtr> pending = std::move(operands);
  while (!pending.empty()) {
    const ExpressionPtr last = std::move(pending.back());
    pending.pop_back();
    std::move(last->operands.begin(), last->operands.end(), std::back_inserter(pending));
    last->operands.clear();
  }
}

ExpressionPtr Parser::node(Expression::Kind kind) const {
  auto made = std::make_unique<Expression>();
  made->kind = kind;
  made->place = peek().place;
  return made;
}

void Parser::adopt(Expression& outer, ExpressionPtr inner) {
  outer.cost = std::min(outer.cost + inner->cost, 1'000'000);
  outer.has_effect = outer.has_effect || inner->has_effect;
  outer.has_loop = outer.has_loop || inner->has_loop;
  outer.operands.push_back(std::move(inner));
}

ExpressionPtr Parser::expression() {
  ExpressionPtr left = assignment();
  while (peek().is(",")) {
    ExpressionPtr made = node(Expression::Kind::sequence);
    ++at_;
    adopt(*made, std::move(left));
    adopt(*made, assignment());
    left = std::move(made);
  }
  return left;
}

ExpressionPtr Parser::assignment() {
  const Level level(*this);
  ExpressionPtr left = conditional();
  if (peek().kind != Token::Kind::punctuation || !contains(assignments, peek().text)) {
    return left;
  }
  ExpressionPtr made = node(Expression::Kind::assign);
  made->text = tokens_[at_++].text;
  adopt(*made, std::move(left));
  adopt(*made, assignment());
  made->has_effect = true;
  return made;
}

ExpressionPtr Parser::conditional() {
  ExpressionPtr condition = binary();
  if (!peek().is("?")) return condition;
  ExpressionPtr made = node(Expression::Kind::conditional);
  ++at_;
  adopt(*made, std::move(condition));
  adopt(*made, expression());
  expect(":");
  adopt(*made, assignment());
  return made;
}

/// All binary operators at once, by a stack of those whose right side is not whole yet:
/// one that follows binds what stands before it unless it binds more tightly.
ExpressionPtr Parser::binary() {
  struct Pending {
    int precedence;
    ExpressionPtr made;  ///< With its left side.
  };
  std::vector<Pending> pending;
  ExpressionPtr last = unary();
  while (true) {
    const int precedence = precedence_of(peek());
    while (!pending.empty() && pending.back().precedence >= precedence) {
      adopt(*pending.back().made, std::move(last));
      last = std::move(pending.back().made);
      pending.pop_back();
    }
    if (precedence < 0) return last;
    ExpressionPtr made = node(Expression::Kind::binary);
    made->text = tokens_[at_++].text;
    adopt(*made, std::move(last));
    pending.push_back({precedence, std::move(made)});
    last = unary();
  }
}

ExpressionPtr Parser::unary() {
  const Level level(*this);
  static constexpr std::string_view operators[] = {"+", "-", "!", "~", "++", "--"};
  std::vector<ExpressionPtr> outer;
  while (peek().kind == Token::Kind::punctuation && contains(operators, peek().text)) {
    const bool steps = peek().text.size() == 2;
    outer.push_back(node(steps ? Expression::Kind::step_before : Expression::Kind::unary));
    outer.back()->text = tokens_[at_++].text;
    outer.back()->has_effect = steps;
  }
  ExpressionPtr result = postfix();
  for (; !outer.empty(); outer.pop_back()) {
    adopt(*outer.back(), std::move(result));
    result = std::move(outer.back());
  }
  return result;
}

ExpressionPtr Parser::postfix() {
  ExpressionPtr left = primary();
  while (true) {
    if (peek().is(".")) {
      ++at_;
      ExpressionPtr made = node(Expression::Kind::member);
      made->text = name();
      adopt(*made, std::move(left));
      left = std::move(made);
    } else if (peek().is("[")) {
      ExpressionPtr made = node(Expression::Kind::index);
      ++at_;
      adopt(*made, std::move(left));
      adopt(*made, expression());
      expect("]");
      left = std::move(made);
    } else if (peek().is("++") || peek().is("--")) {
      ExpressionPtr made = node(Expression::Kind::step_after);
      made->text = tokens_[at_++].text;
      adopt(*made, std::move(left));
      made->has_effect = true;
      left = std::move(made);
    } else {
      return left;
    }
  }
}

ExpressionPtr Parser::primary() {
  const Token& token = peek();
  if (take("(")) {
    ExpressionPtr inner = expression();
    expect(")");
    return inner;
  }
  if (token.kind == Token::Kind::integer || token.kind == Token::Kind::natural ||
      token.kind == Token::Kind::number) {
    return literal();
  }
  if (token.is("true") || token.is("false")) {
    ExpressionPtr made = node(Expression::Kind::literal);
    made->type = bool_type;
    made->bits = token.is("true") ? 1 : 0;
    ++at_;
    return made;
  }
  if (type_named(token)) return construction();
  ExpressionPtr made = node(Expression::Kind::name);
  made->text = name();
  if (!take("(")) return made;
  made->kind = Expression::Kind::call;
  arguments(*made);
  note_call(*made);
  return made;
}

ExpressionPtr Parser::construction() {
  ExpressionPtr made = node(Expression::Kind::construct);
  made->type = type();
  if (made->type.is_void()) unexpected("an expression");
  expect("(");
  arguments(*made);
  if (made->type.length < 0) made->type.length = static_cast<int>(made->operands.size());
  return made;
}

void Parser::arguments(Expression& call) {
  const Level level(*this);
  if (peek().is("void") && peek(1).is(")")) ++at_;
  while (!take(")")) {
    if (!call.operands.empty()) expect(",");
    adopt(call, assignment());
  }
}

void Parser::note_call(Expression& call) {
  int cost = 0;
  bool any = false;
  for (const Syntax* syntax : {static_cast<const Syntax*>(into_), &known_}) {
    if (syntax == nullptr) continue;
    const auto found = syntax->by_name.find(call.text);
    if (found == syntax->by_name.end()) continue;
    for (const Function* function : found->second) {
      any = true;
      cost = std::max(cost, function->cost);
      for (const Function::Parameter& parameter : function->parameters) {
        call.has_effect = call.has_effect || parameter.out;
      }
      call.has_loop = call.has_loop || function->has_loop;
      if (function->stays_inline && function_ != nullptr) function_->stays_inline = true;
    }
  }
  call.cost = std::min(call.cost + (any ? cost : 4), 1'000'000);
  const bool needs_neighbours =
      call.text.starts_with("dFd") || call.text == "fwidth" || call.text.starts_with("texture");
  if (needs_neighbours && function_ != nullptr) function_->stays_inline = true;
}

ExpressionPtr Parser::literal() {
  const Token& token = tokens_[at_];
  ExpressionPtr made = node(Expression::Kind::literal);
  std::string_view digits = token.text;
  if (token.kind == Token::Kind::number) {
    while (!digits.empty() && (digits.back() == 'f' || digits.back() == 'F')) {
      digits.remove_suffix(1);
    }
    double value = 0.0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code != std::errc() || end != digits.data() + digits.size() || !(value < 3.5e38)) {
      error(token.place, "glsl-number", "the number is not one a float can hold", {},
            std::string(token.text));
    }
    made->type = float_type;
    made->bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  } else {
    made->type = token.kind == Token::Kind::natural ? uint_type : int_type;
    if (token.kind == Token::Kind::natural) digits.remove_suffix(1);
    const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
    if (hexadecimal) digits.remove_prefix(2);
    std::uint32_t value = 0;
    const auto [end, code] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 10);
    if (code != std::errc() || end != digits.data() + digits.size()) {
      error(token.place, "glsl-number", "the number does not fit 32 bits", {},
            std::string(token.text));
    }
    made->bits = value;
  }
  ++at_;
  return made;
}

}  // namespace nacre::glsl
