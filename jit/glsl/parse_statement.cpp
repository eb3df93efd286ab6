// Statements: the parser's second part.
#include <fmt/format.h>

#include "jit/glsl/parser.h"

namespace nacre::glsl {

StatementPtr Parser::make(Statement::Kind kind) {
  auto made = std::make_unique<Statement>();
  made->kind = kind;
  made->place = peek().place;
  return made;
}

void Parser::absorb(Statement& outer, const Statement& inner) {
  outer.cost = std::min(outer.cost + inner.cost, 1'000'000);
  outer.may_leave = outer.may_leave || inner.may_leave;
  outer.has_loop = outer.has_loop || inner.has_loop;
  outer.assigned.insert(inner.assigned.begin(), inner.assigned.end());
}

void Parser::absorb(Statement& outer, const Expression* inner) {
  if (inner == nullptr) return;
  outer.cost = std::min(outer.cost + inner->cost, 1'000'000);
  outer.has_loop = outer.has_loop || inner->has_loop;
  if (inner->has_effect) collect_assigned(*inner, outer.assigned);
}

void Parser::collect_assigned(const Expression& expression, std::set<std::string_view>& names) {
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
    if (at->kind == Kind::assign || at->kind == Kind::step_before || at->kind == Kind::step_after) {
      root(at->operands[0].get());
    }
    // Which of the arguments are written to is known when it is recorded.
    if (at->kind == Kind::call && at->has_effect) {
      for (const ExpressionPtr& operand : at->operands) root(operand.get());
    }
    for (const ExpressionPtr& operand : at->operands) pending.push_back(operand.get());
  }
}

StatementPtr Parser::block() {
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

StatementPtr Parser::statement() {
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

StatementPtr Parser::declaration() {
  StatementPtr made = make(Statement::Kind::declare);
  const Place place = peek().place;
  bool constant = false;
  while (take("const")) constant = true;
  const Type declared = type();
  if (declared.is_void()) error(place, "glsl-type", "a variable cannot be void");
  variables(declared, name(), constant, place, *made);
  return made;
}

void Parser::variables(const Type& declared, std::string_view first, bool constant, Place place,
                       Statement& into) {
  std::string_view variable_name = first;
  while (true) {
    Statement::Variable variable;
    variable.name = variable_name;
    variable.type = declared;
    variable.constant = constant;
    variable.place = place;
    if (const int length = array_length()) variable.type.length = length;
    check_size(variable.type, place);
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

ExpressionPtr Parser::initializer_list() {
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

StatementPtr Parser::if_statement() {
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

StatementPtr Parser::for_statement() {
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

StatementPtr Parser::while_statement() {
  StatementPtr made = make(Statement::Kind::loop);
  expect("while");
  expect("(");
  made->body.push_back(nullptr);
  made->condition = expression();
  expect(")");
  finish_loop(*made);
  return made;
}

void Parser::finish_loop(Statement& loop) {
  ++loops_;
  loop.body.push_back(statement());
  --loops_;
  if (loop.body[0]) absorb(loop, *loop.body[0]);
  absorb(loop, *loop.body[1]);
  absorb(loop, loop.condition.get());
  absorb(loop, loop.step.get());
  loop.cost = std::min(loop.cost * 8 + 64, 1'000'000);
  loop.has_loop = true;
}

StatementPtr Parser::do_statement() {
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
  made->has_loop = true;
  return made;
}

StatementPtr Parser::return_statement() {
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

StatementPtr Parser::jump() {
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

}  // namespace nacre::glsl
