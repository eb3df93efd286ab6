#include "jit/glsl/parse.h"

#include <fmt/format.h>

#include <cstdlib>

#include "jit/glsl/parser.h"

namespace nacre::glsl {

namespace {

constexpr int max_nesting = 200;
constexpr int max_length = 4096;  ///< Of an array; also scalars in a structure.
constexpr int max_struct_depth = 32;
constexpr int max_parts = 65536;  ///< Scalars of one variable.

/// a op b for the sizes of arrays; nothing beyond what sizes may be.
std::optional<long long> combined(std::string_view op, long long a, std::optional<long long> b) {
  constexpr long long most = 1LL << 31;
  if (!b || std::abs(a) > most || std::abs(*b) > most) return std::nullopt;
  if (op == "+") return a + *b;
  if (op == "-") return a - *b;
  return op == "*" ? std::optional(a * *b) : std::nullopt;
}

constexpr std::string_view qualifiers[] = {"highp", "mediump", "lowp", "flat", "precise"};
constexpr std::string_view refused[] = {"discard", "switch", "case",   "uniform",
                                        "layout",  "buffer", "varying"};

}  // namespace

void Parser::expect(std::string_view text) {
  if (!take(text)) unexpected(fmt::format("'{}'", text));
}

void Parser::enter() {
  if (++levels_entered_ % 1024 == 0) check_stop(stop_, sources_, diagnostics_, peek().place);
  if (++depth_ <= max_nesting) return;
  error(peek().place, "glsl-too-deep", "the text is nested too deeply",
        fmt::format("at most {} levels", max_nesting));
}

void Parser::text() {
  while (!at_end()) {
    if (take(";")) continue;
    top_level();
  }
}

ExpressionPtr Parser::lone_expression() {
  ExpressionPtr result = expression();
  take(";");
  if (!at_end()) unexpected("the end of the expression");
  return result;
}

bool Parser::take(std::string_view text) {
  if (!peek().is(text)) return false;
  ++at_;
  return true;
}

std::string_view Parser::name() {
  if (peek().kind != Token::Kind::name || contains(refused, peek().text)) unexpected("a name");
  return tokens_[at_++].text;
}

void Parser::unexpected(std::string expected) {
  const Token& token = peek();
  if (contains(refused, token.text)) {
    error(token.place, "glsl-unsupported",
          fmt::format("'{}' is not in the subset of GLSL that runs here", token.text));
  }
  error(token.place, "glsl-syntax", "the text is not well-formed", std::move(expected),
        token.kind == Token::Kind::end ? "the end of the text" : fmt::format("'{}'", token.text));
}

void Parser::error(Place place, std::string code, std::string message, std::string expected,
                   std::string found) {
  fail(sources_, diagnostics_, place, std::move(code), std::move(message), std::move(expected),
       std::move(found));
}

const Struct* Parser::find_struct(std::string_view text) const {
  for (const Syntax* syntax : {static_cast<const Syntax*>(into_), &known_}) {
    if (syntax == nullptr) continue;
    const auto found = syntax->struct_by_name.find(text);
    if (found != syntax->struct_by_name.end()) return found->second;
  }
  return nullptr;
}

std::optional<Type> Parser::type_named(const Token& token) const {
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

bool Parser::at_type() const {
  const Token& token = peek();
  if (token.is("const") || contains(qualifiers, token.text)) return true;
  // A constructor is an expression, a type before a name or brackets is not.
  return type_named(token).has_value() && !peek(1).is("(") && !is_array_constructor();
}

bool Parser::at_sampler(std::size_t ahead) const {
  while (contains(qualifiers, peek(ahead).text)) ++ahead;
  const std::optional<Type> found = type_named(peek(ahead));
  return found && found->base == Base::sampler;
}

bool Parser::is_array_constructor() const {
  if (!peek(1).is("[")) return false;
  std::size_t ahead = 2;
  while (!peek(ahead).is("]") && peek(ahead).kind != Token::Kind::end) ++ahead;
  return peek(ahead + 1).is("(");
}

void Parser::skip_qualifiers() {
  while (contains(qualifiers, peek().text)) ++at_;
}

Type Parser::type() {
  skip_qualifiers();
  const std::optional<Type> found = type_named(peek());
  if (!found) unexpected("a type");
  ++at_;
  Type result = *found;
  result.length = array_length();
  return result;
}

int Parser::array_length() {
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

std::optional<long long> Parser::constant(const Expression& expression) const {
  std::vector<const Expression*> chain;
  const Expression* first = &expression;
  for (; first->kind == Expression::Kind::binary; first = first->operands[0].get()) {
    chain.push_back(first);
  }
  std::optional<long long> value;
  if (first->kind == Expression::Kind::literal && first->type.base != Base::number) {
    value = static_cast<std::int32_t>(first->bits);
  } else if (first->kind == Expression::Kind::name && into_ != nullptr) {
    const auto global = into_->global_by_name.find(first->text);
    if (global != into_->global_by_name.end()) value = global->second->whole;
  }
  for (; value && !chain.empty(); chain.pop_back()) {
    value = combined(chain.back()->text, *value, constant(*chain.back()->operands[1]));
  }
  return value;
}

void Parser::top_level() {
  if (peek().is("precision")) {
    while (!at_end() && !take(";")) ++at_;
    return;
  }
  if (peek().is("struct")) {
    structure();
    return;
  }
  const Place place = peek().place;
  const bool is_uniform = peek().is("uniform") && at_sampler(1);
  if (is_uniform) take("uniform");
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
    const bool is_sampler = variable.type.base == Base::sampler && !variable.type.is_array();
    if (is_sampler != is_uniform || (is_sampler && variable.initial != nullptr)) {
      error(place, "glsl-type", fmt::format("'{}' cannot be declared so", variable.name),
            "samplers as 'uniform sampler2D NAME;', nothing else as uniform");
    }
    if (variable.constant && variable.initial) variable.whole = this->constant(*variable.initial);
    auto global = std::make_shared<const Statement::Variable>(std::move(variable));
    into_->global_by_name.emplace(global->name, global.get());
    into_->globals.push_back(std::move(global));
  }
}

void Parser::structure() {
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
      made->add({member_name, one});
      if (made->parts > max_length || made->depth > max_struct_depth) {
        error(peek().place, "glsl-too-large", "the structure is too large",
              fmt::format("at most {} numbers, and structures {} deep", max_length,
                          max_struct_depth));
      }
    } while (take(","));
    expect(";");
  }
  expect(";");
  into_->struct_by_name.insert_or_assign(made->name, made.get());
  into_->structs.push_back(std::move(made));
}

void Parser::check_size(const Type& type, Place place) {
  if (type.length < 0 || part_count(type) <= max_parts) return;
  error(place, "glsl-too-large", fmt::format("a {} is too large", to_string(type)),
        fmt::format("at most {} numbers", max_parts));
}

void Parser::function(const Type& result, std::string_view function_name, Place place) {
  auto made = std::make_unique<Function>();
  made->name = function_name;
  made->type = result;
  made->place = place;
  check_size(result, place);
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
    made->has_loop = made->body->has_loop;
    function_ = nullptr;
  }
  add_function(std::move(made));
}

Function::Parameter Parser::parameter() {
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
  check_size(result.type, peek().place);
  return result;
}

void Parser::add_function(std::unique_ptr<Function> made) {
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

void parse(const std::vector<Token>& tokens, const Sources& sources, Diagnostics& diagnostics,
           Syntax& into, const Stop& stop) {
  Parser(tokens, sources, diagnostics, into, &into, stop).text();
}

ExpressionPtr parse_expression(const std::vector<Token>& tokens, const Sources& sources,
                               Diagnostics& diagnostics, const Syntax& context, const Stop& stop) {
  return Parser(tokens, sources, diagnostics, context, nullptr, stop).lone_expression();
}

}  // namespace nacre::glsl
