#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "jit/glsl/value.h"

/// Functions over numbers applied to every component, scalars spread (GLSL 4.60, 8).
/// Nothing where the arguments do not fit.
namespace nacre::glsl {

using Arguments = std::span<const Value>;

inline bool all_floats(Arguments arguments) {
  return std::all_of(arguments.begin(), arguments.end(), [](const Value& value) {
    return value.type.is_plain() && !value.type.is_matrix() && value.type.base != Base::boolean;
  });
}

/// The type of the longest argument, if all others are as long or scalars.
inline std::optional<Type> common_type(Arguments arguments) {
  Type type = arguments[0].type;
  for (const Value& value : arguments) {
    if (value.type.rows > type.rows) type = type.with_rows(value.type.rows);
  }
  for (const Value& value : arguments) {
    if (value.type.rows != 1 && value.type.rows != type.rows) return std::nullopt;
  }
  return type;
}

template <std::size_t N, class F>
std::optional<Value> floats(Arguments arguments, F&& f) {
  if (arguments.size() != N || !all_floats(arguments)) return std::nullopt;
  const std::optional<Type> type = common_type(arguments);
  if (!type) return std::nullopt;
  std::array<Value, N> as_float;
  for (std::size_t i = 0; i < N; ++i) {
    as_float[i] = convert(arguments[i], arguments[i].type.with_base(Base::number));
  }
  Value result{type->with_base(Base::number), {}, {}};
  for (std::size_t at = 0; at < type->rows; ++at) {
    const auto part = [&](std::size_t i) {
      return as_float[i].number(as_float[i].type.rows == 1 ? 0 : at);
    };
    if constexpr (N == 1) result.parts.push_back(f(part(0)).ref());
    if constexpr (N == 2) result.parts.push_back(f(part(0), part(1)).ref());
    if constexpr (N == 3) result.parts.push_back(f(part(0), part(1), part(2)).ref());
  }
  return result;
}

/// The same for functions that whole numbers have too; f gets Ints or Floats.
template <std::size_t N, class F>
std::optional<Value> numbers(Arguments arguments, F&& f) {
  const bool whole = std::all_of(arguments.begin(), arguments.end(),
                                 [](const Value& value) { return value.type.is_whole(); });
  if (!whole) return floats<N>(arguments, f);
  if (arguments.size() != N) return std::nullopt;
  const std::optional<Type> type = common_type(arguments);
  if (!type) return std::nullopt;
  Value result{*type, {}, {}};
  for (std::size_t at = 0; at < type->rows; ++at) {
    const auto part = [&](std::size_t i) {
      return arguments[i].whole(arguments[i].type.rows == 1 ? 0 : at);
    };
    if constexpr (N == 1) result.parts.push_back(f(part(0)).ref());
    if constexpr (N == 2) result.parts.push_back(f(part(0), part(1)).ref());
    if constexpr (N == 3) result.parts.push_back(f(part(0), part(1), part(2)).ref());
  }
  return result;
}

}  // namespace nacre::glsl
