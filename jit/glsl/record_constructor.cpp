// Values made of others: constructors, and what stands behind a declaration's "=".
#include <fmt/format.h>

#include "jit/glsl/part.h"
#include "jit/glsl/recording.h"

namespace nacre::glsl {

Value Recording::construct(const Expression& expression) {
  const Level level(*this, expression.place, 500);
  std::vector<Value> arguments;
  arguments.reserve(expression.operands.size());
  for (const ExpressionPtr& operand : expression.operands) arguments.push_back(evaluate(*operand));
  const Type& type = expression.type;
  if (type.is_plain()) return construct_plain(expression, arguments);
  // A structure from its members, an array from its elements.
  std::vector<Type> wanted;
  if (type.is_array()) {
    wanted.assign(static_cast<std::size_t>(type.length), type.element());
  } else if (type.base == Base::structure) {
    for (const Struct::Member& part : type.structure->members) wanted.push_back(part.type);
  }
  if (wanted.size() != arguments.size() || wanted.empty()) {
    error(expression.place, "glsl-constructor",
          fmt::format("a {} cannot be made of this many values", to_string(type)),
          std::to_string(wanted.size()), std::to_string(arguments.size()));
  }
  Value result{type, {}, {}};
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Value part = expect(arguments[i], wanted[i], expression.operands[i]->place);
    result.parts.insert(result.parts.end(), part.parts.begin(), part.parts.end());
  }
  return result;
}

Value Recording::construct_plain(const Expression& expression,
                                 const std::vector<Value>& arguments) {
  const Type& type = expression.type;
  const auto wanted = static_cast<std::size_t>(part_count(type));
  if (type.is_matrix() && arguments.size() == 1 && arguments[0].type.is_plain() &&
      !arguments[0].type.is_vector()) {
    return construct_matrix(type, arguments[0]);
  }
  Value result{type, {}, {}};
  for (const Value& argument : arguments) {
    if (!argument.type.is_plain() || result.parts.size() >= wanted) {
      error(expression.place, "glsl-constructor",
            fmt::format("a {} cannot be made of {}", to_string(type), type_list(arguments)));
    }
    for (const Ref part : argument.parts) {
      if (result.parts.size() == wanted) break;  // vec3(vec4): the rest is dropped.
      result.parts.push_back(convert(part, argument.type.base, type.base));
    }
  }
  if (arguments.size() == 1 && result.parts.size() == 1) {
    result.parts.resize(wanted, result.parts[0]);
  }
  if (result.parts.size() != wanted) {
    error(expression.place, "glsl-constructor",
          fmt::format("a {} cannot be made of {}", to_string(type), type_list(arguments)));
  }
  return result;
}

/// From a scalar its multiple of the identity, from a matrix its upper left,
/// filled up with the identity.
Value Recording::construct_matrix(const Type& type, const Value& argument) const {
  Value result{type, {}, {}};
  for (int column = 0; column < type.columns; ++column) {
    for (int row = 0; row < type.rows; ++row) {
      Ref part = Ref::literal(row == column ? 1.0f : 0.0f);
      if (argument.type.is_matrix() && row < argument.type.rows && column < argument.type.columns) {
        part = argument.parts[static_cast<std::size_t>(column) * argument.type.rows +
                              static_cast<std::size_t>(row)];
      } else if (argument.type.is_scalar() && row == column) {
        part = convert(argument.parts[0], argument.type.base, Base::number);
      }
      result.parts.push_back(part);
    }
  }
  return result;
}

Value Recording::initial_value(const Expression& expression, const Type& type) {
  const Level level(*this, expression.place, 600);
  if (expression.kind != Expression::Kind::list) {
    Value value = evaluate(expression);
    if (type.length < 0 && value.type.is_array() && value.type.element() == type.element()) {
      return value;
    }
    return expect(value, type, expression.place);
  }
  Expression made;
  made.kind = Expression::Kind::construct;
  made.place = expression.place;
  made.type = type;
  if (type.length < 0) made.type.length = static_cast<int>(expression.operands.size());
  Value result{made.type, {}, {}};
  // { ... } stands for the constructor of what is declared, at every level.
  const bool of_structure = type.base == Base::structure && !type.is_array();
  const std::optional<Type> each = of_structure ? std::nullopt : element_type(made.type);
  const std::size_t wanted = of_structure
                                 ? type.structure->members.size()
                                 : static_cast<std::size_t>(each ? element_count(made.type) : 0);
  if (wanted != expression.operands.size()) {
    error(expression.place, "glsl-constructor",
          fmt::format("the list does not fit a {}", to_string(made.type)), std::to_string(wanted),
          std::to_string(expression.operands.size()));
  }
  for (std::size_t i = 0; i < wanted; ++i) {
    const Type& part = of_structure ? type.structure->members[i].type : *each;
    const Value value = initial_value(*expression.operands[i], part);
    result.parts.insert(result.parts.end(), value.parts.begin(), value.parts.end());
  }
  return result;
}

}  // namespace nacre::glsl
