// Assignments: where they go and what they write.
#include <fmt/format.h>

#include <algorithm>

#include "jit/glsl/operators.h"
#include "jit/glsl/part.h"
#include "jit/glsl/recording.h"

namespace nacre::glsl {

Recording::Target Recording::target(const Expression& expression) {
  // "a.b.c" from the left, without recursion: see evaluate().
  using Kind = Expression::Kind;
  std::vector<const Expression*> chain;
  const Expression* first = &expression;
  for (; first->kind == Kind::member || first->kind == Kind::index;
       first = first->operands[0].get()) {
    chain.push_back(first);
  }
  Target result = target_variable(*first);
  for (; !chain.empty(); chain.pop_back()) {
    count_steps(1, chain.back()->place);
    result = chain.back()->kind == Kind::member ? target_member(*chain.back(), std::move(result))
                                                : target_index(*chain.back(), result);
  }
  return result;
}

Recording::Target Recording::target_variable(const Expression& expression) {
  if (expression.kind == Expression::Kind::name) {
    Variable* variable = find(expression.text);
    if (variable != nullptr && !variable->constant) {
      Target result;
      result.slot = static_cast<Slot>(variable - variables_.data());
      result.type = variable->value.type;
      std::vector<std::size_t> parts(variable->value.parts.size());
      for (std::size_t i = 0; i < parts.size(); ++i) parts[i] = i;
      result.alternatives.push_back({true, std::move(parts)});
      return result;
    }
    if (variable == nullptr) name(expression);  // Complains about what does not exist.
  }
  error(expression.place, "glsl-assignment", "this cannot be assigned to", "a variable");
}

Recording::Target Recording::target_member(const Expression& expression, Target result) const {
  std::vector<std::size_t> parts;
  if (result.type.base == Base::structure && !result.type.is_array()) {
    if (const auto found = find_member(result.type, expression.text)) {
      for (int i = 0; i < part_count(found->second); ++i) {
        parts.push_back(found->first + static_cast<std::size_t>(i));
      }
      result.type = found->second;
    }
  } else if (result.type.is_plain() && !result.type.is_matrix()) {
    parts = swizzle(expression.text, result.type.rows);
    std::vector<std::size_t> sorted = parts;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
      error(expression.place, "glsl-assignment", "a component is assigned to twice");
    }
    result.type = result.type.with_rows(static_cast<int>(parts.size()));
  }
  if (parts.empty()) {
    error(expression.place, "glsl-member", fmt::format("there is no member '{}'", expression.text));
  }
  for (Target::Parts& alternative : result.alternatives) {
    std::vector<std::size_t> chosen;
    chosen.reserve(parts.size());
    for (const std::size_t part : parts) chosen.push_back(alternative.parts[part]);
    alternative.parts = std::move(chosen);
  }
  return result;
}

Recording::Target Recording::target_index(const Expression& expression, const Target& whole) {
  const Level level(*this, expression.place, 700);
  const Value index = evaluate(*expression.operands[1]);
  const std::optional<Type> type = element_type(whole.type);
  if (!type || !index.type.is_whole() || !index.type.is_scalar()) {
    error(expression.place, "glsl-index",
          fmt::format("a {} cannot be indexed", to_string(whole.type)));
  }
  const int count = element_count(whole.type);
  const auto size = static_cast<std::size_t>(part_count(*type));
  const Int at = index.whole(0);
  if (at.is_constant() && (at.constant() < 0 || at.constant() >= count)) {
    error(expression.place, "glsl-index", "the index is outside of the range",
          fmt::format("0 to {}", count - 1), std::to_string(at.constant()));
  }
  Target result;
  result.slot = whole.slot;
  result.type = *type;
  for (const Target::Parts& alternative : whole.alternatives) {
    for (int i = 0; i < count; ++i) {
      if (at.is_constant() && at.constant() != i) continue;
      const auto first = alternative.parts.begin() +
                         static_cast<std::ptrdiff_t>(static_cast<std::size_t>(i) * size);
      result.alternatives.push_back(
          {alternative.where & (at == Int(i)),
           std::vector<std::size_t>(first, first + static_cast<std::ptrdiff_t>(size))});
    }
  }
  return result;
}

Value Recording::read(const Target& target) const {
  const std::vector<Ref>& parts = variables_[target.slot].value.parts;
  Value result = zero(target.type);
  for (const Target::Parts& alternative : target.alternatives) {
    for (std::size_t i = 0; i < alternative.parts.size(); ++i) {
      const Ref part = parts[alternative.parts[i]];
      result.parts[i] = record(Op::select, {alternative.where.ref(), part, result.parts[i]});
    }
  }
  return result;
}

void Recording::write(const Target& target, const Value& value) {
  std::vector<Ref>& parts = variables_[target.slot].value.parts;
  for (const Target::Parts& alternative : target.alternatives) {
    for (std::size_t i = 0; i < alternative.parts.size(); ++i) {
      Ref& part = parts[alternative.parts[i]];
      part = record(Op::select, {alternative.where.ref(), value.parts[i], part});
    }
  }
}

Value Recording::assign(const Expression& expression) {
  const Level level(*this, expression.place, 550);
  Value value = evaluate(*expression.operands[1]);
  const Target to = target(*expression.operands[0]);
  if (expression.text != "=") {
    const std::string_view op = expression.text.substr(0, expression.text.size() - 1);
    const Value before = read(to);
    const std::optional<Value> result = binary(op, before, value);
    if (!result) {
      error(expression.place, "glsl-type",
            fmt::format("'{}' does not work on {} and {}", expression.text, to_string(before.type),
                        to_string(value.type)));
    }
    value = *result;
  }
  value = expect(value, to.type, expression.place);
  write(to, value);
  return value;
}

Value Recording::step(const Expression& expression, bool value_before) {
  const Level level(*this, expression.place, 700);
  const Target to = target(*expression.operands[0]);
  const Value before = read(to);
  const Value one = before.type.base == Base::number ? make(Float(1.0f)) : make(Int(1));
  const std::optional<Value> after =
      binary(expression.text == "++" ? "+" : "-", before, convert(one, before.type.with_rows(1)));
  if (!after || before.type.base == Base::boolean) {
    error(expression.place, "glsl-type",
          fmt::format("'{}' does not work on {}", expression.text, to_string(before.type)));
  }
  write(to, *after);
  return value_before ? before : *after;
}

}  // namespace nacre::glsl
