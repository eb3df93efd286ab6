#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "jit/glsl/parse.h"
#include "runtime/stop.h"

namespace nacre::glsl {

template <class List>
bool contains(const List& list, std::string_view text) {
  return std::find(std::begin(list), std::end(list), text) != std::end(list);
}

/// Recursive descent over the tokens of a text; the implementation of parse.h.
class Parser {
 public:
  Parser(const std::vector<Token>& tokens, const Sources& sources, Diagnostics& diagnostics,
         const Syntax& known, Syntax* into, const Stop& stop)
      : tokens_(tokens),
        sources_(sources),
        diagnostics_(diagnostics),
        known_(known),
        into_(into),
        stop_(stop) {}

  void text();
  ExpressionPtr lone_expression();

 private:
  // Tokens (parse.cpp)
  const Token& peek(std::size_t ahead = 0) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
  }
  bool at_end() const { return peek().kind == Token::Kind::end; }
  bool take(std::string_view text);
  void expect(std::string_view text);
  std::string_view name();
  [[noreturn]] void unexpected(std::string expected);
  [[noreturn]] void error(Place place, std::string code, std::string message,
                          std::string expected = {}, std::string found = {});

  void enter();
  /// Counts a level of nesting for as long as it lives.
  class Level {
   public:
    explicit Level(Parser& parser) : parser_(parser) { parser.enter(); }
    ~Level() { --parser_.depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    Parser& parser_;
  };

  // Types (parse.cpp)
  const Struct* find_struct(std::string_view text) const;
  std::optional<Type> type_named(const Token& token) const;
  bool at_type() const;
  bool at_sampler(std::size_t ahead) const;
  bool is_array_constructor() const;
  void skip_qualifiers();
  Type type();
  /// "[3]" or "[]" if one comes; -1 for "[]", which needs an initializer.
  int array_length();
  std::optional<long long> constant(const Expression& expression) const;

  // Top level (parse.cpp)
  void top_level();
  void structure();
  void function(const Type& result, std::string_view function_name, Place place);
  Function::Parameter parameter();
  void add_function(std::unique_ptr<Function> made);

  // Statements (parse_statement.cpp)
  StatementPtr make(Statement::Kind kind);
  static void absorb(Statement& outer, const Statement& inner);
  /// Says what is too large for a variable, argument or result.
  void check_size(const Type& type, Place place);
  static void absorb(Statement& outer, const Expression* inner);
  static void collect_assigned(const Expression& expression, std::set<std::string_view>& names);
  StatementPtr block();
  StatementPtr statement();
  StatementPtr declaration();
  /// The rest of a declaration, from behind the first name to the ';'.
  void variables(const Type& declared, std::string_view first, bool constant, Place place,
                 Statement& into);
  ExpressionPtr initializer_list();
  StatementPtr if_statement();
  StatementPtr for_statement();
  StatementPtr while_statement();
  void finish_loop(Statement& loop);
  StatementPtr do_statement();
  StatementPtr return_statement();
  StatementPtr jump();

  // Expressions (parse_expression.cpp)
  ExpressionPtr node(Expression::Kind kind) const;
  static void adopt(Expression& outer, ExpressionPtr inner);
  ExpressionPtr expression();
  ExpressionPtr assignment();
  ExpressionPtr conditional();
  ExpressionPtr binary();
  ExpressionPtr unary();
  ExpressionPtr postfix();
  ExpressionPtr primary();
  ExpressionPtr construction();
  void arguments(Expression& call);
  /// What calling a function of that name costs and changes at most.
  void note_call(Expression& call);
  ExpressionPtr literal();

  const std::vector<Token>& tokens_;
  const Sources& sources_;
  Diagnostics& diagnostics_;
  const Syntax& known_;
  Syntax* into_;
  const Stop& stop_;
  std::size_t at_ = 0;
  std::size_t levels_entered_ = 0;
  int depth_ = 0;
  int loops_ = 0;
  Function* function_ = nullptr;
};

}  // namespace nacre::glsl
