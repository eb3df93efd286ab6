#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "jit/glsl/token.h"
#include "jit/glsl/type.h"

namespace nacre::glsl {

/// A node of a tree that is as deep as a text has terms: "a + b + c" leans to the left.
/// Nothing that walks over it may call itself for operands[0].
struct Expression {
  Expression() = default;
  Expression(Expression&&) = default;
  Expression& operator=(Expression&&) = default;
  ~Expression();

  enum class Kind : std::uint8_t {
    literal,      ///< `type`, `bits`
    name,         ///< `text`
    member,       ///< operands[0] . `text`: a member, or components as in v.xyz
    index,        ///< operands[0] [ operands[1] ]
    call,         ///< `text` ( operands... )
    construct,    ///< `type` ( operands... )
    unary,        ///< `text` operands[0]: + - ! ~
    binary,       ///< operands[0] `text` operands[1]; && and || look at the left first.
    assign,       ///< operands[0] `text` operands[1]: = += ...
    step_before,  ///< `text` operands[0]: ++ --
    step_after,   ///< operands[0] `text`
    conditional,  ///< operands[0] ? operands[1] : operands[2]
    sequence,     ///< operands[0] , operands[1]
    list,         ///< { operands... }, as an initializer
  };
  Kind kind = Kind::literal;
  Place place;
  std::string_view text;
  Type type;
  std::uint32_t bits = 0;
  std::vector<std::unique_ptr<Expression>> operands;
  /// Operations in it, functions that it calls included: for what to skip.
  int cost = 1;
  /// May change a variable.
  bool has_effect = false;
  /// Calls a function that has a loop.
  bool has_loop = false;
};
using ExpressionPtr = std::unique_ptr<Expression>;

struct Statement {
  enum class Kind : std::uint8_t {
    block,       ///< { body... }
    declare,     ///< `variables`
    expression,  ///< `condition`
    if_,         ///< if (condition) body[0] else body[1]
    loop,        ///< for / while: init body[0] or null; condition; step; body[1]
    do_loop,     ///< do body[0] while (condition)
    return_,     ///< condition or null
    break_,
    continue_,
  };
  struct Variable {
    std::string_view name;
    Type type;
    bool constant = false;
    ExpressionPtr initial;  ///< May be null.
    Place place;
    std::optional<long long> whole;  ///< What a constant at the top of a text is.
  };
  Kind kind = Kind::block;
  Place place;
  ExpressionPtr condition;
  ExpressionPtr step;
  std::vector<std::unique_ptr<Statement>> body;
  std::vector<Variable> variables;
  int cost = 0;
  /// Holds a return, break or continue.
  bool may_leave = false;
  /// Is or holds a loop, or calls a function that does.
  bool has_loop = false;
  /// Names of variables that may be assigned in it.
  std::set<std::string_view> assigned;
};
using StatementPtr = std::unique_ptr<Statement>;

struct Function {
  struct Parameter {
    std::string_view name;
    Type type;
    bool in = true;
    bool out = false;
  };
  std::string_view name;
  Type type;
  std::vector<Parameter> parameters;
  StatementPtr body;  ///< Null: declared only.
  Place place;
  int cost = 1;
  /// Uses derivatives or textures, here or in what it calls: stays in line.
  bool stays_inline = false;
  bool has_loop = false;  ///< Here or in what it calls.
};

/// A text that was read. A copy shares what is in it, and more can be read into it.
struct Syntax {
  std::vector<std::shared_ptr<const Struct>> structs;
  std::vector<std::shared_ptr<const Function>> functions;
  std::vector<std::shared_ptr<const Statement::Variable>> globals;
  std::map<std::string_view, std::vector<const Function*>> by_name;
  /// The last of each name, and the first.
  std::map<std::string_view, const Struct*> struct_by_name;
  std::map<std::string_view, const Statement::Variable*> global_by_name;
};

}  // namespace nacre::glsl
