#include <fmt/format.h>

#include <algorithm>

#include "jit/glsl/builtins.h"
#include "jit/glsl/operators.h"
#include "jit/glsl/part.h"
#include "jit/glsl/recording.h"

namespace nacre::glsl {

namespace {

std::string type_list(const std::vector<Value>& values) {
  std::string text;
  for (const Value& value : values) {
    if (!text.empty()) text += ", ";
    text += to_string(value.type);
  }
  return fmt::format("({})", text);
}

/// Kinds that begin with the value of operands[0].
bool starts_left(Expression::Kind kind) {
  using Kind = Expression::Kind;
  return kind == Kind::member || kind == Kind::index || kind == Kind::unary ||
         kind == Kind::binary || kind == Kind::conditional || kind == Kind::sequence;
}

Value slice(const Value& value, std::size_t first, const Type& type) {
  Value result{type, {}, {}};
  const auto begin = value.parts.begin() + static_cast<std::ptrdiff_t>(first);
  result.parts.assign(begin, begin + part_count(type));
  return result;
}

}  // namespace

/// What stands leftmost is evaluated first, then what is done with it, step by step: "a + b
/// + c", "a.b.c", "- - a" may be as long as a text, and take no more stack than "a".
Value Recording::evaluate(const Expression& expression) {
  const Level level(*this, expression.place, 500);
  std::vector<const Expression*> chain;
  const Expression* first = &expression;
  for (; starts_left(first->kind); first = first->operands[0].get()) chain.push_back(first);
  Value value = leaf(*first);
  for (; !chain.empty(); chain.pop_back()) value = apply(*chain.back(), std::move(value));
  return value;
}

Value Recording::apply(const Expression& expression, Value left) {
  using Kind = Expression::Kind;
  count_steps(1, expression.place);
  switch (expression.kind) {
    case Kind::member: return member(expression, left);
    case Kind::index: return index(expression, left);
    case Kind::unary: return unary_value(expression, left);
    case Kind::binary: return binary_value(expression, left);
    case Kind::conditional: return conditional(expression, left);
    default: return evaluate(*expression.operands[1]);  // A sequence.
  }
}

Value Recording::leaf(const Expression& expression) {
  using Kind = Expression::Kind;
  count_steps(1, expression.place);
  switch (expression.kind) {
    case Kind::literal: {
      Ref part = Ref::literal(static_cast<std::int32_t>(expression.bits));
      if (expression.type == float_type) part.type = Scalar::f32;
      if (expression.type == bool_type) part.type = Scalar::b1;
      return {expression.type, {part}, {}};
    }
    case Kind::name: return name(expression);
    case Kind::call: return call_named(expression);
    case Kind::construct: return construct(expression);
    case Kind::assign: return assign(expression);
    case Kind::step_before: return step(expression, false);
    case Kind::step_after: return step(expression, true);
    default: break;
  }
  error(expression.place, "glsl-syntax", "a list stands only where a variable is declared");
}

Value Recording::expect(const Value& value, const Type& type, Place place) {
  if (!converts(value.type, type)) {
    error(place, "glsl-type", "the types do not agree", to_string(type), to_string(value.type));
  }
  return convert(value, type);
}

Value Recording::name(const Expression& expression) {
  count_steps((variables_.size() - frame().first) / 64, expression.place);  // They are searched.
  if (const Variable* variable = find(expression.text)) return variable->value;
  const auto& globals = context_.syntax.global_by_name;
  if (const auto found = globals.find(expression.text); found != globals.end()) {
    const Statement::Variable* global = found->second;
    if (global->type.base == Base::sampler) return uniform_sampler(*global);
    if (!global->initial || std::find(reading_globals_.begin(), reading_globals_.end(),
                                      global->name) != reading_globals_.end()) {
      error(expression.place, "glsl-undefined",
            fmt::format("the global '{}' has no value", expression.text));
    }
    // Its initializer sees other globals, not the variables around this use.
    Frame alone;
    alone.first = variables_.size();
    frames_.push_back(alone);
    reading_globals_.push_back(global->name);
    Value value = initial_value(*global->initial, global->type);
    reading_globals_.pop_back();
    frames_.pop_back();
    return value;
  }
  error(expression.place, "glsl-undefined", fmt::format("there is no '{}'", expression.text));
}

Value Recording::uniform_sampler(const Statement::Variable& global) {
  Value value{global.type, {}, std::string(global.name)};
  value.is_uniform = true;
  return value;
}

Value Recording::member(const Expression& expression, const Value& whole) const {
  if (whole.type.base == Base::structure && !whole.type.is_array()) {
    if (const auto found = find_member(whole.type, expression.text)) {
      return slice(whole, found->first, found->second);
    }
  } else if (whole.type.is_plain() && !whole.type.is_matrix()) {
    const std::vector<std::size_t> parts = swizzle(expression.text, whole.type.rows);
    if (!parts.empty()) {
      Value result{whole.type.with_rows(static_cast<int>(parts.size())), {}, {}};
      for (const std::size_t part : parts) result.parts.push_back(whole.parts[part]);
      return result;
    }
  }
  error(expression.place, "glsl-member",
        fmt::format("{} has no member '{}'", to_string(whole.type), expression.text));
}

Value Recording::index(const Expression& expression, const Value& whole) {
  const Level level(*this, expression.place, 250);
  return element(whole, evaluate(*expression.operands[1]), expression.place);
}

/// An index that is not literal chooses among all elements; outside of the
/// range it means the nearest.
Value Recording::element(const Value& whole, const Value& index, Place place) {
  const std::optional<Type> type = element_type(whole.type);
  if (!type || !index.type.is_whole() || !index.type.is_scalar()) {
    error(place, "glsl-index", fmt::format("a {} cannot be indexed", to_string(whole.type)),
          "an array, a matrix or a vector, and a whole number");
  }
  const int count = element_count(whole.type);
  const auto size = static_cast<std::size_t>(part_count(*type));
  const Int at = index.whole(0);
  if (at.is_constant()) {
    if (at.constant() < 0 || at.constant() >= count) {
      error(place, "glsl-index", "the index is outside of the range",
            fmt::format("0 to {}", count - 1), std::to_string(at.constant()));
    }
    return slice(whole, static_cast<std::size_t>(at.constant()) * size, *type);
  }
  Value result = slice(whole, 0, *type);
  for (int i = 1; i < count; ++i) {
    const Bool here = at >= Int(i);
    for (std::size_t k = 0; k < size; ++k) {
      const Ref part = whole.parts[static_cast<std::size_t>(i) * size + k];
      result.parts[k] = record(Op::select, {here.ref(), part, result.parts[k]});
    }
  }
  return result;
}

Value Recording::unary_value(const Expression& expression, const Value& operand) const {
  if (std::optional<Value> result = unary(expression.text, operand)) return *result;
  error(expression.place, "glsl-type",
        fmt::format("'{}' does not work on {}", expression.text, to_string(operand.type)));
}

Value Recording::binary_value(const Expression& expression, const Value& a) {
  const Level level(*this, expression.place, 450);
  const bool is_lazy = expression.text == "&&" || expression.text == "||";
  if (is_lazy &&
      (expression.operands[1]->has_effect || expression.operands[1]->cost >= cheap_branch)) {
    return look_ahead(expression, a);
  }
  const Value b = evaluate(*expression.operands[1]);
  if (std::optional<Value> result = binary(expression.text, a, b)) return *result;
  error(expression.place, "glsl-type",
        fmt::format("'{}' does not work on {} and {}", expression.text, to_string(a.type),
                    to_string(b.type)));
}

/// && and || whose right side is evaluated only where the left leaves it open.
Value Recording::look_ahead(const Expression& expression, const Value& first) {
  const Level level(*this, expression.place, 850);
  const bool is_and = expression.text == "&&";
  const Value left = expect(first, bool_type, expression.place);
  Value result;
  scoped([&] {
    const Slot slot = push("", left);
    branch(
        is_and ? left.truth(0) : !left.truth(0), expression.operands[1]->cost, expression.place,
        [&] {
          variables_[slot].value =
              expect(evaluate(*expression.operands[1]), bool_type, expression.place);
        },
        [] {});
    result = variables_[slot].value;
  });
  return result;
}

/// Both sides are computed; what they assign holds in the lanes that take them.
Value Recording::conditional(const Expression& expression, const Value& asked) {
  const Level level(*this, expression.place, 950);
  const Value condition = expect(asked, bool_type, expression.place);
  if (condition.parts[0].is_constant()) {
    return evaluate(*expression.operands[condition.parts[0].is_constant(1u) ? 1 : 2]);
  }
  Value a;
  Value b;
  branch(
      condition.truth(0), 0, expression.place, [&] { a = evaluate(*expression.operands[1]); },
      [&] { b = evaluate(*expression.operands[2]); });
  if (converts(a.type, b.type)) {
    a = convert(a, b.type);
  } else {
    b = expect(b, a.type, expression.place);
  }
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    if (is_same(a.parts[i], b.parts[i])) continue;
    a.parts[i] = record(Op::select, {condition.parts[0], a.parts[i], b.parts[i]});
  }
  return a;
}

// -- Constructors

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

// -- Calls

Value Recording::call_named(const Expression& expression) {
  const Level level(*this, expression.place, 550);
  std::vector<Value> arguments;
  arguments.reserve(expression.operands.size());
  for (const ExpressionPtr& operand : expression.operands) arguments.push_back(evaluate(*operand));
  const Function* function = select_overload(expression, arguments);
  if (function == nullptr) {
    if (expression.text.starts_with("texture")) return call_texture(expression, arguments);
    const BuiltinResult result = call_builtin(expression.text, arguments);
    if (result.value) return *result.value;
    error(expression.place, "glsl-call",
          fmt::format("there is no function {}{}", expression.text, type_list(arguments)));
  }
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (function->parameters[i].in)
      arguments[i] = convert(arguments[i], function->parameters[i].type);
  }
  const CallResult result = call(*function, std::move(arguments), expression.place);
  for (std::size_t i = 0; i < function->parameters.size(); ++i) {
    const Function::Parameter& parameter = function->parameters[i];
    if (!parameter.out) continue;
    const Target to = target(*expression.operands[i]);
    write(to, expect(result.outputs[i], to.type, expression.operands[i]->place));
  }
  return result.value;
}

/// The overload with these types, or the only one that they convert to.
const Function* Recording::select_overload(const Expression& expression,
                                           const std::vector<Value>& arguments) {
  const auto found = context_.syntax.by_name.find(expression.text);
  if (found == context_.syntax.by_name.end()) return nullptr;
  const Function* best = nullptr;
  int best_conversions = 0;
  bool ambiguous = false;
  for (const Function* candidate : found->second) {
    if (candidate->parameters.size() != arguments.size()) continue;
    int conversions = 0;
    bool fits = true;
    for (std::size_t i = 0; i < arguments.size() && fits; ++i) {
      const Function::Parameter& parameter = candidate->parameters[i];
      fits = (!parameter.in || converts(arguments[i].type, parameter.type)) &&
             (!parameter.out || converts(parameter.type, arguments[i].type));
      if (arguments[i].type != parameter.type) ++conversions;
    }
    if (!fits) continue;
    ambiguous = best != nullptr && conversions == best_conversions;
    if (best == nullptr || conversions < best_conversions) {
      best = candidate;
      best_conversions = conversions;
    }
  }
  if (ambiguous) {
    error(expression.place, "glsl-call",
          fmt::format("several functions fit {}{}", expression.text, type_list(arguments)));
  }
  if (best == nullptr && !is_builtin(expression.text)) {
    error(expression.place, "glsl-call",
          fmt::format("no function '{}' takes {}", expression.text, type_list(arguments)));
  }
  return best;
}

Value Recording::call_texture(const Expression& expression, const std::vector<Value>& arguments) {
  const bool with_gradient = expression.text == "textureGrad";
  const std::size_t count = with_gradient ? 4 : 2;
  bool fits = (expression.text == "texture" || with_gradient) && arguments.size() == count &&
              arguments[0].type.base == Base::sampler && !arguments[0].type.is_array();
  for (std::size_t i = 1; i < count && fits; ++i) {
    fits = arguments[i].type == float_type.with_rows(arguments[0].type.rows);
  }
  if (!fits) {
    error(expression.place, "glsl-call",
          fmt::format("there is no function {}{}", expression.text, type_list(arguments)),
          "texture(sampler2D, vec2), textureGrad(sampler2D, vec2, vec2, vec2), or of other axes");
  }
  std::optional<Value> result;
  if (context_.texture) {
    result = context_.texture(arguments[0], arguments[1], with_gradient ? &arguments[2] : nullptr,
                              with_gradient ? &arguments[3] : nullptr);
  }
  if (!result && arguments[0].is_uniform) {
    error(expression.place, "glsl-texture",
          fmt::format("nothing is bound to the sampler '{}'", arguments[0].text));
  }
  if (!result) error(expression.place, "glsl-texture", "images cannot be read here");
  return *result;
}

}  // namespace nacre::glsl
