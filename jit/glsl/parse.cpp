#include "jit/glsl/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>

namespace nacre::glsl {

namespace {

constexpr int max_nesting = 200;
constexpr int max_length = 4096;  ///< Of an array; also scalars in a structure.

// Binary operators, the loosest first.
constexpr std::string_view precedence[][4] = {
    {"||"},       {"^^"},     {"&&"},         {"|"},
    {"^"},        {"&"},      {"==", "!="},   {"<", ">", "<=", ">="},
    {"<<", ">>"}, {"+", "-"}, {"*", "/", "%"}};
constexpr int levels = static_cast<int>(std::size(precedence));

constexpr std::string_view assignments[] = {
    "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "<<=", ">>="};
constexpr std::string_view qualifiers[] = {"highp", "mediump", "lowp", "flat", "precise"};
constexpr std::string_view refused[] = {"discard", "switch", "case",   "uniform",
                                        "layout",  "buffer", "varying"};

template <class List>
bool contains(const List& list, std::string_view text) {
  return std::find(std::begin(list), std::end(list), text) != std::end(list);
}

class Parser {
 public:
  Parser(const std::vector<Token>& tokens, const Sources& sources, Diagnostics& diagnostics,
         const Syntax& known, Syntax* into)
      : tokens_(tokens), sources_(sources), diagnostics_(diagnostics), known_(known), into_(into) {}

  void text() {
    while (!at_end()) {
      if (take(";")) continue;
      top_level();
    }
  }

  ExpressionPtr lone_expression() {
    ExpressionPtr result = expression();
    take(";");
    if (!at_end()) unexpected("the end of the expression");
    return result;
  }

 private:
  // -- Tokens

  const Token& peek(std::size_t ahead = 0) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  bool at_end() const { return peek().kind == Token::Kind::end; }
  bool take(std::string_view text) {
    if (!peek().is(text)) return false;
    ++at_;
    return true;
  }
  void expect(std::string_view text) {
    if (!take(text)) unexpected(fmt::format("'{}'", text));
  }
  std::string_view name() {
    if (peek().kind != Token::Kind::name || contains(refused, peek().text)) unexpected("a name");
    return tokens_[at_++].text;
  }
  [[noreturn]] void unexpected(std::string expected) {
    const Token& token = peek();
    if (contains(refused, token.text)) {
      error(token.place, "glsl-unsupported",
            fmt::format("'{}' is not in the subset of GLSL that runs here", token.text));
    }
    error(token.place, "glsl-syntax", "the text is not well-formed", std::move(expected),
          token.kind == Token::Kind::end ? "the end of the text" : fmt::format("'{}'", token.text));
  }
  [[noreturn]] void error(Place place, std::string code, std::string message,
                          std::string expected = {}, std::string found = {}) {
    fail(sources_, diagnostics_, place, std::move(code), std::move(message), std::move(expected),
         std::move(found));
  }

  /// Counts a level of nesting for as long as it lives.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) {
      if (++parser.depth_ > max_nesting) {
        parser.error(parser.peek().place, "glsl-too-deep", "the text is nested too deeply",
                     fmt::format("at most {} levels", max_nesting));
      }
    }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  // -- Types

  const Struct* find_struct(std::string_view text) const {
    for (const Syntax* syntax : {static_cast<const Syntax*>(into_), &known_}) {
      if (syntax == nullptr) continue;
      for (auto at = syntax->structs.rbegin(); at != syntax->structs.rend(); ++at) {
        if ((*at)->name == text) return at->get();
      }
    }
    return nullptr;
  }

  std::optional<Type> type_named(const Token& token) const {
    if (token.kind != Token::Kind::name) return std::nullopt;
    bool found = false;
    Type type = builtin_type(token.text, found);
    if (found) return type;
    const Struct* structure = find_struct(token.text);
    if (structure == nullptr) return std::nullopt;
    type.base = Base::structure;
    type.structure = structure;
    return type;
  }

  bool at_type() const {
    const Token& token = peek();
    if (token.is("const") || contains(qualifiers, token.text)) return true;
    // A constructor is an expression, a type before a name or brackets is not.
    return type_named(token).has_value() && !peek(1).is("(") && !is_array_constructor();
  }

  bool is_array_constructor() const {
    if (!peek(1).is("[")) return false;
    std::size_t ahead = 2;
    while (!peek(ahead).is("]") && peek(ahead).kind != Token::Kind::end) ++ahead;
    return peek(ahead + 1).is("(");
  }

  void skip_qualifiers() {
    while (contains(qualifiers, peek().text)) ++at_;
  }

  Type type() {
    skip_qualifiers();
    const std::optional<Type> found = type_named(peek());
    if (!found) unexpected("a type");
    ++at_;
    Type result = *found;
    result.length = array_length();
    return result;
  }

  /// "[3]" or "[]" if one comes; -1 for "[]", which needs an initializer.
  int array_length() {
    if (!take("[")) return 0;
    if (take("]")) return -1;
    const Place place = peek().place;
    const ExpressionPtr size = expression();
    expect("]");
    const std::optional<long long> length = constant(*size);
    if (!length || *length < 1 || *length > max_length) {
      error(place, "glsl-array-size", "the size of an array must be a constant",
            fmt::format("a whole number from 1 to {}", max_length));
    }
    return static_cast<int>(*length);
  }

  std::optional<long long> constant(const Expression& expression) const {
    if (expression.kind == Expression::Kind::literal && expression.type.base != Base::number) {
      return static_cast<std::int32_t>(expression.bits);
    }
    if (expression.kind == Expression::Kind::name && into_ != nullptr) {
      for (const Statement::Variable& global : into_->globals) {
        if (global.name == expression.text && global.constant && global.initial) {
          return constant(*global.initial);
        }
      }
    }
    if (expression.kind != Expression::Kind::binary) return std::nullopt;
    const std::optional<long long> a = constant(*expression.operands[0]);
    const std::optional<long long> b = constant(*expression.operands[1]);
    if (!a || !b) return std::nullopt;
    if (expression.text == "+") return *a + *b;
    if (expression.text == "-") return *a - *b;
    if (expression.text == "*" && std::abs(*a) < 65536 && std::abs(*b) < 65536) return *a * *b;
    return std::nullopt;
  }

  // -- Top level

  void top_level() {
    if (peek().is("precision")) {
      while (!at_end() && !take(";")) ++at_;
      return;
    }
    if (peek().is("struct")) {
      structure();
      return;
    }
    const Place place = peek().place;
    const bool constant = take("const");
    const Type declared = type();
    const std::string_view declared_name = name();
    if (peek().is("(")) {
      function(declared, declared_name, place);
      return;
    }
    Statement declaration;
    variables(declared, declared_name, constant, place, declaration);
    for (Statement::Variable& variable : declaration.variables) {
      into_->globals.push_back(std::move(variable));
    }
  }

  void structure() {
    expect("struct");
    auto made = std::make_unique<Struct>();
    made->name = name();
    expect("{");
    while (!take("}")) {
      const Type member = type();
      do {
        Type one = member;
        const std::string_view member_name = name();
        if (const int length = array_length()) one.length = length;
        if (one.length < 0 || one.is_void()) unexpected("a member with a size");
        made->members.push_back({member_name, one});
      } while (take(","));
      expect(";");
    }
    expect(";");
    int parts = 0;
    for (const Struct::Member& member : made->members) parts += part_count(member.type);
    if (parts > max_length) error(peek().place, "glsl-too-large", "the structure is too large");
    into_->structs.push_back(std::move(made));
  }

  void function(const Type& result, std::string_view function_name, Place place) {
    auto made = std::make_unique<Function>();
    made->name = function_name;
    made->type = result;
    made->place = place;
    expect("(");
    if (peek().is("void") && peek(1).is(")")) ++at_;
    while (!take(")")) {
      if (!made->parameters.empty()) expect(",");
      made->parameters.push_back(parameter());
    }
    if (!take(";")) {
      function_ = made.get();
      made->body = block();
      made->cost += made->body->cost;
      function_ = nullptr;
    }
    add_function(std::move(made));
  }

  Function::Parameter parameter() {
    Function::Parameter result;
    while (true) {
      skip_qualifiers();
      if (take("const") || take("in")) continue;
      if (take("out")) {
        result.in = false;
        result.out = true;
      } else if (take("inout")) {
        result.out = true;
      } else {
        break;
      }
    }
    result.type = type();
    if (result.type.is_void()) unexpected("the type of a parameter");
    if (!peek().is(",") && !peek().is(")")) result.name = name();
    if (const int length = array_length()) result.type.length = length;
    if (result.type.length < 0) unexpected("the size of the array");
    return result;
  }

  void add_function(std::unique_ptr<Function> made) {
    std::vector<const Function*>& same_name = into_->by_name[made->name];
    const auto same = [&](const Function* other) {
      return std::equal(made->parameters.begin(), made->parameters.end(), other->parameters.begin(),
                        other->parameters.end(),
                        [](const auto& a, const auto& b) { return a.type == b.type; });
    };
    const auto found = std::find_if(same_name.begin(), same_name.end(), same);
    if (found == same_name.end()) {
      same_name.push_back(made.get());
    } else if ((*found)->body == nullptr) {
      *found = made.get();
    } else if (made->body != nullptr) {
      if ((*found)->place.file == made->place.file) {
        error(made->place, "glsl-redefined",
              fmt::format("function '{}' is defined twice with these parameters", made->name));
      }
      *found = made.get();
    }
    into_->functions.push_back(std::move(made));
  }

  // -- Statements

  StatementPtr make(Statement::Kind kind) {
    auto made = std::make_unique<Statement>();
    made->kind = kind;
    made->place = peek().place;
    return made;
  }

  static void absorb(Statement& outer, const Statement& inner) {
    outer.cost = std::min(outer.cost + inner.cost, 1'000'000);
    outer.may_leave = outer.may_leave || inner.may_leave;
    outer.assigned.insert(inner.assigned.begin(), inner.assigned.end());
  }

  void absorb(Statement& outer, const Expression* inner) const {
    if (inner == nullptr) return;
    outer.cost = std::min(outer.cost + inner->cost, 1'000'000);
    if (inner->has_effect) collect_assigned(*inner, outer.assigned);
  }

  static void collect_assigned(const Expression& expression, std::set<std::string_view>& names) {
    std::vector<const Expression*> pending{&expression};
    const auto root = [&](const Expression* target) {
      while (target->kind == Expression::Kind::member || target->kind == Expression::Kind::index) {
        target = target->operands[0].get();
      }
      if (target->kind == Expression::Kind::name) names.insert(target->text);
    };
    while (!pending.empty()) {
      const Expression* at = pending.back();
      pending.pop_back();
      using Kind = Expression::Kind;
      if (at->kind == Kind::assign || at->kind == Kind::step_before ||
          at->kind == Kind::step_after) {
        root(at->operands[0].get());
      }
      // Which of the arguments are written to is known when it is recorded.
      if (at->kind == Kind::call && at->has_effect) {
        for (const ExpressionPtr& operand : at->operands) root(operand.get());
      }
      for (const ExpressionPtr& operand : at->operands) pending.push_back(operand.get());
    }
  }

  StatementPtr block() {
    const Level level(*this);
    StatementPtr made = make(Statement::Kind::block);
    expect("{");
    while (!take("}")) {
      if (at_end()) unexpected("'}'");
      made->body.push_back(statement());
      absorb(*made, *made->body.back());
    }
    return made;
  }

  StatementPtr statement() {
    const Level level(*this);
    if (peek().is("{")) return block();
    if (take(";")) return make(Statement::Kind::block);
    if (peek().is("if")) return if_statement();
    if (peek().is("for")) return for_statement();
    if (peek().is("while")) return while_statement();
    if (peek().is("do")) return do_statement();
    if (peek().is("return")) return return_statement();
    if (peek().is("break") || peek().is("continue")) return jump();
    if (at_type()) return declaration();
    StatementPtr made = make(Statement::Kind::expression);
    made->condition = expression();
    expect(";");
    absorb(*made, made->condition.get());
    return made;
  }

  StatementPtr declaration() {
    StatementPtr made = make(Statement::Kind::declare);
    const Place place = peek().place;
    bool constant = false;
    while (take("const")) constant = true;
    const Type declared = type();
    if (declared.is_void()) error(place, "glsl-type", "a variable cannot be void");
    variables(declared, name(), constant, place, *made);
    return made;
  }

  /// The rest of a declaration, from behind the first name to the ';'.
  void variables(const Type& declared, std::string_view first, bool constant, Place place,
                 Statement& into) {
    std::string_view variable_name = first;
    while (true) {
      Statement::Variable variable;
      variable.name = variable_name;
      variable.type = declared;
      variable.constant = constant;
      variable.place = place;
      if (const int length = array_length()) variable.type.length = length;
      if (take("=")) {
        variable.initial = peek().is("{") ? initializer_list() : assignment();
        absorb(into, variable.initial.get());
      }
      into.variables.push_back(std::move(variable));
      if (!take(",")) break;
      place = peek().place;
      variable_name = name();
    }
    expect(";");
  }

  ExpressionPtr initializer_list() {
    const Level level(*this);
    ExpressionPtr made = node(Expression::Kind::list);
    expect("{");
    while (!take("}")) {
      if (!made->operands.empty()) expect(",");
      if (take("}")) break;
      adopt(*made, peek().is("{") ? initializer_list() : assignment());
    }
    return made;
  }

  StatementPtr if_statement() {
    StatementPtr made = make(Statement::Kind::if_);
    expect("if");
    expect("(");
    made->condition = expression();
    expect(")");
    absorb(*made, made->condition.get());
    made->body.push_back(statement());
    if (take("else")) made->body.push_back(statement());
    for (const StatementPtr& branch : made->body) absorb(*made, *branch);
    return made;
  }

  StatementPtr for_statement() {
    StatementPtr made = make(Statement::Kind::loop);
    expect("for");
    expect("(");
    if (take(";")) {
      made->body.push_back(nullptr);
    } else if (at_type()) {
      made->body.push_back(declaration());
    } else {
      StatementPtr init = make(Statement::Kind::expression);
      init->condition = expression();
      expect(";");
      absorb(*init, init->condition.get());
      made->body.push_back(std::move(init));
    }
    if (!peek().is(";")) made->condition = expression();
    expect(";");
    if (!peek().is(")")) made->step = expression();
    expect(")");
    finish_loop(*made);
    return made;
  }

  StatementPtr while_statement() {
    StatementPtr made = make(Statement::Kind::loop);
    expect("while");
    expect("(");
    made->body.push_back(nullptr);
    made->condition = expression();
    expect(")");
    finish_loop(*made);
    return made;
  }

  void finish_loop(Statement& loop) {
    ++loops_;
    loop.body.push_back(statement());
    --loops_;
    if (loop.body[0]) absorb(loop, *loop.body[0]);
    absorb(loop, *loop.body[1]);
    absorb(loop, loop.condition.get());
    absorb(loop, loop.step.get());
    loop.cost = std::min(loop.cost * 8 + 64, 1'000'000);
  }

  StatementPtr do_statement() {
    StatementPtr made = make(Statement::Kind::do_loop);
    expect("do");
    ++loops_;
    made->body.push_back(statement());
    --loops_;
    expect("while");
    expect("(");
    made->condition = expression();
    expect(")");
    expect(";");
    absorb(*made, *made->body[0]);
    absorb(*made, made->condition.get());
    made->cost = std::min(made->cost * 8 + 64, 1'000'000);
    return made;
  }

  StatementPtr return_statement() {
    StatementPtr made = make(Statement::Kind::return_);
    const Place place = peek().place;
    expect("return");
    if (!peek().is(";")) made->condition = expression();
    expect(";");
    if (function_ != nullptr && function_->type.is_void() != (made->condition == nullptr)) {
      error(place, "glsl-type",
            fmt::format("function '{}' returns {}", function_->name, to_string(function_->type)));
    }
    absorb(*made, made->condition.get());
    made->may_leave = true;
    return made;
  }

  StatementPtr jump() {
    const bool is_break = peek().is("break");
    StatementPtr made = make(is_break ? Statement::Kind::break_ : Statement::Kind::continue_);
    if (loops_ == 0) {
      error(peek().place, "glsl-syntax", fmt::format("'{}' outside of a loop", peek().text));
    }
    ++at_;
    expect(";");
    made->may_leave = true;
    return made;
  }

  // -- Expressions

  ExpressionPtr node(Expression::Kind kind) const {
    auto made = std::make_unique<Expression>();
    made->kind = kind;
    made->place = peek().place;
    return made;
  }

  static void adopt(Expression& outer, ExpressionPtr inner) {
    outer.cost = std::min(outer.cost + inner->cost, 1'000'000);
    outer.has_effect = outer.has_effect || inner->has_effect;
    outer.operands.push_back(std::move(inner));
  }

  ExpressionPtr expression() {
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

  ExpressionPtr assignment() {
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

  ExpressionPtr conditional() {
    ExpressionPtr condition = binary(0);
    if (!peek().is("?")) return condition;
    ExpressionPtr made = node(Expression::Kind::conditional);
    ++at_;
    adopt(*made, std::move(condition));
    adopt(*made, expression());
    expect(":");
    adopt(*made, assignment());
    return made;
  }

  ExpressionPtr binary(int level) {
    if (level == levels) return unary();
    ExpressionPtr left = binary(level + 1);
    while (peek().kind == Token::Kind::punctuation && !peek().text.empty() &&
           contains(precedence[level], peek().text)) {
      ExpressionPtr made = node(Expression::Kind::binary);
      made->text = tokens_[at_++].text;
      adopt(*made, std::move(left));
      adopt(*made, binary(level + 1));
      left = std::move(made);
    }
    return left;
  }

  ExpressionPtr unary() {
    const Level level(*this);
    for (const std::string_view candidate : {"+", "-", "!", "~", "++", "--"}) {
      if (!peek().is(candidate)) continue;
      ExpressionPtr made =
          node(candidate.size() == 2 ? Expression::Kind::step_before : Expression::Kind::unary);
      made->text = candidate;
      ++at_;
      adopt(*made, unary());
      if (candidate.size() == 2) made->has_effect = true;
      return made;
    }
    return postfix();
  }

  ExpressionPtr postfix() {
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

  ExpressionPtr primary() {
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

  ExpressionPtr construction() {
    ExpressionPtr made = node(Expression::Kind::construct);
    made->type = type();
    if (made->type.is_void()) unexpected("an expression");
    expect("(");
    arguments(*made);
    if (made->type.length < 0) made->type.length = static_cast<int>(made->operands.size());
    return made;
  }

  void arguments(Expression& call) {
    const Level level(*this);
    if (peek().is("void") && peek(1).is(")")) ++at_;
    while (!take(")")) {
      if (!call.operands.empty()) expect(",");
      adopt(call, assignment());
    }
  }

  /// What calling a function of that name costs and changes at most.
  void note_call(Expression& call) {
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
        if (function->stays_inline && function_ != nullptr) function_->stays_inline = true;
      }
    }
    call.cost = std::min(call.cost + (any ? cost : 4), 1'000'000);
    const bool needs_neighbours =
        call.text.starts_with("dFd") || call.text == "fwidth" || call.text.starts_with("texture");
    if (needs_neighbours && function_ != nullptr) function_->stays_inline = true;
  }

  ExpressionPtr literal() {
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
      const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value,
                                               hexadecimal ? 16 : 10);
      if (code != std::errc() || end != digits.data() + digits.size()) {
        error(token.place, "glsl-number", "the number does not fit 32 bits", {},
              std::string(token.text));
      }
      made->bits = value;
    }
    ++at_;
    return made;
  }

  const std::vector<Token>& tokens_;
  const Sources& sources_;
  Diagnostics& diagnostics_;
  const Syntax& known_;
  Syntax* into_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int loops_ = 0;
  Function* function_ = nullptr;
};

}  // namespace

void parse(const std::vector<Token>& tokens, const Sources& sources, Diagnostics& diagnostics,
           Syntax& into) {
  Parser(tokens, sources, diagnostics, into, &into).text();
}

ExpressionPtr parse_expression(const std::vector<Token>& tokens, const Sources& sources,
                               Diagnostics& diagnostics, const Syntax& context) {
  return Parser(tokens, sources, diagnostics, context, nullptr).lone_expression();
}

}  // namespace nacre::glsl
