// What expressions come to: names, parts, operators and choices.
#include <fmt/format.h>

#include <algorithm>

#include "jit/glsl/operators.h"
#include "jit/glsl/part.h"
#include "jit/glsl/recording.h"

namespace nacre::glsl {

namespace {

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
  count_steps((variables_.size() - activation().first) / 64,
              expression.place);  // They are searched.
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
    Activation alone;
    alone.first = variables_.size();
    activations_.push_back(alone);
    reading_globals_.push_back(global->name);
    Value value = initial_value(*global->initial, global->type);
    reading_globals_.pop_back();
    activations_.pop_back();
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
  if (expression.text == "&&" || expression.text == "||") return look_ahead(expression, a);
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
        is_and ? left.truth(0) : !left.truth(0), expression.place,
        [&] {
          variables_[slot].value =
              expect(evaluate(*expression.operands[1]), bool_type, expression.place);
        },
        [] {});
    result = variables_[slot].value;
  });
  return result;
}

/// Each side is evaluated, and assigns, in the lanes that take it.
Value Recording::conditional(const Expression& expression, const Value& asked) {
  const Level level(*this, expression.place, 950);
  const Value condition = expect(asked, bool_type, expression.place);
  if (condition.parts[0].is_constant()) {
    return evaluate(*expression.operands[condition.parts[0].is_constant(1u) ? 1 : 2]);
  }
  Value a;
  Value b;
  branch(
      condition.truth(0), expression.place, [&] { a = evaluate(*expression.operands[1]); },
      [&] { b = evaluate(*expression.operands[2]); }, {&a, &b});
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

}  // namespace nacre::glsl
