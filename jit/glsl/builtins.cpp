#include "jit/glsl/builtins.h"

#include <algorithm>
#include <array>
#include <utility>

#include "jit/glsl/matrix.h"
#include "jit/glsl/operators.h"

namespace nacre::glsl {

namespace {

using Arguments = std::span<const Value>;
using Builtin = std::optional<Value> (*)(Arguments);
constexpr auto none = std::nullopt;

// -- Helpers: componentwise functions over floats, scalars spread.

bool all_floats(Arguments arguments) {
  return std::all_of(arguments.begin(), arguments.end(), [](const Value& value) {
    return value.type.is_plain() && !value.type.is_matrix() && value.type.base != Base::boolean;
  });
}

/// The type of the longest argument, if all others are as long or scalars.
std::optional<Type> common_type(Arguments arguments) {
  Type type = arguments[0].type;
  for (const Value& value : arguments) {
    if (value.type.rows > type.rows) type = type.with_rows(value.type.rows);
  }
  for (const Value& value : arguments) {
    if (value.type.rows != 1 && value.type.rows != type.rows) return none;
  }
  return type;
}

template <std::size_t N, class F>
std::optional<Value> floats(Arguments arguments, F&& f) {
  if (arguments.size() != N || !all_floats(arguments)) return none;
  const std::optional<Type> type = common_type(arguments);
  if (!type) return none;
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
  if (arguments.size() != N) return none;
  const std::optional<Type> type = common_type(arguments);
  if (!type) return none;
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

/// Float vectors of one length.
bool same_vectors(Arguments arguments, std::size_t count) {
  if (arguments.size() != count) return false;
  for (const Value& value : arguments) {
    if (!value.type.is_float() || value.type.is_matrix()) return false;
    if (value.type != arguments[0].type) return false;
  }
  return true;
}

Float dot(const Value& a, const Value& b) {
  Float sum = a.number(0) * b.number(0);
  for (std::size_t i = 1; i < a.parts.size(); ++i) sum = sum + a.number(i) * b.number(i);
  return sum;
}

Value scaled(const Value& a, Float s) {
  Value result{a.type, {}, {}};
  for (std::size_t i = 0; i < a.parts.size(); ++i) result.parts.push_back((a.number(i) * s).ref());
  return result;
}

Value sum(const Value& a, const Value& b) {
  Value result{a.type, {}, {}};
  for (std::size_t i = 0; i < a.parts.size(); ++i) {
    result.parts.push_back((a.number(i) + b.number(i)).ref());
  }
  return result;
}

// -- 8.1, 8.2: angles, trigonometry, exponentials

constexpr double pi = 3.14159265358979323846;

template <Float (*f)(Float)>
std::optional<Value> each(Arguments a) {
  return floats<1>(a, f);
}

std::optional<Value> glsl_radians(Arguments a) {
  return floats<1>(a, [](Float x) { return x * Float(pi / 180.0); });
}
std::optional<Value> glsl_degrees(Arguments a) {
  return floats<1>(a, [](Float x) { return x * Float(180.0 / pi); });
}
std::optional<Value> glsl_atan(Arguments a) {
  if (a.size() == 1) return floats<1>(a, [](Float x) { return atan2(x, 1.0f); });
  return floats<2>(a, [](Float y, Float x) { return atan2(y, x); });
}
std::optional<Value> glsl_sinh(Arguments a) {
  return floats<1>(a, [](Float x) { return (exp(x) - exp(-x)) * 0.5f; });
}
std::optional<Value> glsl_cosh(Arguments a) {
  return floats<1>(a, [](Float x) { return (exp(x) + exp(-x)) * 0.5f; });
}
std::optional<Value> glsl_tanh(Arguments a) {
  return floats<1>(a, [](Float x) {
    const Float e = exp(-2.0f * abs(x));
    const Float size = (1.0f - e) / (1.0f + e);
    return select(x < 0.0f, -size, size);
  });
}
std::optional<Value> glsl_pow(Arguments a) {
  return floats<2>(a, [](Float x, Float y) { return pow(x, y); });
}
std::optional<Value> glsl_inversesqrt(Arguments a) {
  return floats<1>(a, [](Float x) { return 1.0f / sqrt(x); });
}

// -- 8.3: common functions

std::optional<Value> glsl_abs(Arguments a) {
  struct {
    Float operator()(Float x) const { return abs(x); }
    Int operator()(Int x) const { return select(x < Int(0), -x, x); }
  } f;
  return numbers<1>(a, f);
}
std::optional<Value> glsl_sign(Arguments a) {
  struct {
    Float operator()(Float x) const { return to_float(x > 0.0f) - to_float(x < 0.0f); }
    Int operator()(Int x) const { return to_int(Int(0) < x) - to_int(x < Int(0)); }
  } f;
  return numbers<1>(a, f);
}
std::optional<Value> min_or_max(Arguments a, bool smaller) {
  const bool natural =
      a.size() == 2 && a[0].type.base == Base::natural && a[1].type.base == Base::natural;
  struct Function {
    bool smaller, natural;
    // In this order NaN in the second operand gives the first, as GLSL says.
    Float operator()(Float x, Float y) const { return smaller ? min(y, x) : max(y, x); }
    Int operator()(Int x, Int y) const {
      const Bool less = natural ? less_unsigned(x, y) : x < y;
      return smaller ? select(less, x, y) : select(less, y, x);
    }
  };
  return numbers<2>(a, Function{smaller, natural});
}
std::optional<Value> glsl_min(Arguments a) { return min_or_max(a, true); }
std::optional<Value> glsl_max(Arguments a) { return min_or_max(a, false); }
std::optional<Value> glsl_clamp(Arguments a) {
  if (a.size() != 3) return none;
  const std::optional<Value> low = glsl_max(a.first(2));
  if (!low) return none;
  return glsl_min(std::array{*low, a[2]});
}
std::optional<Value> glsl_mix(Arguments a) {
  if (a.size() != 3) return none;
  if (a[2].type.base != Base::boolean) {
    return floats<3>(a, [](Float x, Float y, Float t) { return x * (1.0f - t) + y * t; });
  }
  if (a[0].type != a[1].type || !a[2].type.is_plain()) return none;
  if (a[2].type.rows != 1 && a[2].type.rows != a[0].type.rows) return none;
  Value result{a[0].type, {}, {}};
  for (std::size_t i = 0; i < a[0].parts.size(); ++i) {
    const Ref choice = a[2].parts[a[2].type.rows == 1 ? 0 : i];
    result.parts.push_back(record(Op::select, {choice, a[1].parts[i], a[0].parts[i]}));
  }
  return result;
}
std::optional<Value> glsl_mod(Arguments a) {
  return floats<2>(a, [](Float x, Float y) { return x - y * floor(x / y); });
}
std::optional<Value> glsl_step(Arguments a) {
  return floats<2>(a,
                   [](Float edge, Float x) { return select(x < edge, Float(0.0f), Float(1.0f)); });
}
std::optional<Value> glsl_smoothstep(Arguments a) {
  return floats<3>(a, [](Float low, Float high, Float x) {
    const Float t = min(max((x - low) / (high - low), 0.0f), 1.0f);
    return t * t * (3.0f - 2.0f * t);
  });
}
std::optional<Value> glsl_fma(Arguments a) {
  return floats<3>(a, [](Float x, Float y, Float z) { return fma(x, y, z); });
}

// -- Bits and classes

std::optional<Value> to_bits(Arguments a, Base base) {
  if (a.size() != 1 || !a[0].type.is_float() || a[0].type.is_matrix()) return none;
  Value result{a[0].type.with_base(base), {}, {}};
  for (std::size_t i = 0; i < a[0].parts.size(); ++i) {
    result.parts.push_back(bits_of(a[0].number(i)).ref());
  }
  return result;
}
std::optional<Value> float_bits_to_int(Arguments a) { return to_bits(a, Base::integer); }
std::optional<Value> float_bits_to_uint(Arguments a) { return to_bits(a, Base::natural); }
std::optional<Value> bits_to_float(Arguments a) {
  if (a.size() != 1 || !a[0].type.is_whole()) return none;
  Value result{a[0].type.with_base(Base::number), {}, {}};
  for (std::size_t i = 0; i < a[0].parts.size(); ++i) {
    result.parts.push_back(float_of_bits(a[0].whole(i)).ref());
  }
  return result;
}
template <class F>
std::optional<Value> classify(Arguments a, F&& f) {
  if (a.size() != 1 || !a[0].type.is_float() || a[0].type.is_matrix()) return none;
  Value result{a[0].type.with_base(Base::boolean), {}, {}};
  for (std::size_t i = 0; i < a[0].parts.size(); ++i) {
    result.parts.push_back(f(a[0].number(i)).ref());
  }
  return result;
}
std::optional<Value> glsl_isnan(Arguments a) {
  return classify(a, [](Float x) { return is_nan(x); });
}
std::optional<Value> glsl_isinf(Arguments a) {
  return classify(a, [](Float x) { return abs(x) > Float(3.402823466e38f); });
}

// -- 8.5: geometric functions

std::optional<Value> glsl_dot(Arguments a) {
  return same_vectors(a, 2) ? std::optional(make(dot(a[0], a[1]))) : none;
}
std::optional<Value> glsl_length(Arguments a) {
  return same_vectors(a, 1) ? std::optional(make(sqrt(dot(a[0], a[0])))) : none;
}
std::optional<Value> glsl_distance(Arguments a) {
  if (!same_vectors(a, 2)) return none;
  const Value between = sum(a[0], scaled(a[1], -1.0f));
  return make(sqrt(dot(between, between)));
}
std::optional<Value> glsl_normalize(Arguments a) {
  if (!same_vectors(a, 1)) return none;
  const Float size = sqrt(dot(a[0], a[0]));
  Value result{a[0].type, {}, {}};
  for (std::size_t i = 0; i < a[0].parts.size(); ++i) {
    result.parts.push_back(select(size > 0.0f, a[0].number(i) / size, Float(0.0f)).ref());
  }
  return result;
}
std::optional<Value> glsl_cross(Arguments a) {
  if (!same_vectors(a, 2) || a[0].type.rows != 3) return none;
  Value result{a[0].type, {}, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    result.parts.push_back(
        (a[0].number(j) * a[1].number(k) - a[0].number(k) * a[1].number(j)).ref());
  }
  return result;
}
std::optional<Value> glsl_reflect(Arguments a) {
  if (!same_vectors(a, 2)) return none;
  return sum(a[0], scaled(a[1], -2.0f * dot(a[1], a[0])));
}
std::optional<Value> glsl_refract(Arguments a) {
  if (a.size() != 3 || !same_vectors(a.first(2), 2) || a[2].type != float_type) return none;
  const Float eta = a[2].number(0);
  const Float cosine = dot(a[1], a[0]);
  const Float k = 1.0f - eta * eta * (1.0f - cosine * cosine);
  Value result = sum(scaled(a[0], eta), scaled(a[1], -(eta * cosine + safe_sqrt(k))));
  for (Ref& part : result.parts) part = select(k < 0.0f, Float(0.0f), Float(part)).ref();
  return result;
}
std::optional<Value> glsl_faceforward(Arguments a) {
  if (!same_vectors(a, 3)) return none;
  const Bool keeps = dot(a[2], a[1]) < 0.0f;
  return scaled(a[0], select(keeps, Float(1.0f), Float(-1.0f)));
}

// -- 8.7: relations of vectors

std::optional<Value> relation(Arguments a, std::string_view op) {
  if (a.size() != 2 || !a[0].type.is_vector() || a[0].type != a[1].type) return none;
  Value result{a[0].type.with_base(Base::boolean), {}, {}};
  const Type scalar = a[0].type.with_rows(1);
  for (std::size_t i = 0; i < a[0].parts.size(); ++i) {
    const std::optional<Value> part =
        binary(op, Value{scalar, {a[0].parts[i]}, {}}, Value{scalar, {a[1].parts[i]}, {}});
    if (!part) return none;
    result.parts.push_back(part->parts[0]);
  }
  return result;
}
std::optional<Value> less_than(Arguments a) { return relation(a, "<"); }
std::optional<Value> less_than_equal(Arguments a) { return relation(a, "<="); }
std::optional<Value> greater_than(Arguments a) { return relation(a, ">"); }
std::optional<Value> greater_than_equal(Arguments a) { return relation(a, ">="); }
std::optional<Value> glsl_equal(Arguments a) { return relation(a, "=="); }
std::optional<Value> not_equal(Arguments a) { return relation(a, "!="); }

std::optional<Value> any_or_all(Arguments a, bool all) {
  if (a.size() != 1 || a[0].type.base != Base::boolean || !a[0].type.is_vector()) return none;
  Bool result = a[0].truth(0);
  for (std::size_t i = 1; i < a[0].parts.size(); ++i) {
    result = all ? result & a[0].truth(i) : result | a[0].truth(i);
  }
  return make(result);
}
std::optional<Value> glsl_any(Arguments a) { return any_or_all(a, false); }
std::optional<Value> glsl_all(Arguments a) { return any_or_all(a, true); }
std::optional<Value> glsl_not(Arguments a) {
  if (a.size() != 1 || a[0].type.base != Base::boolean || !a[0].type.is_vector()) return none;
  Value result = a[0];
  for (std::size_t i = 0; i < result.parts.size(); ++i) result.parts[i] = (!a[0].truth(i)).ref();
  return result;
}

// -- 8.14: derivatives, along the footprint of the shading point

std::optional<Value> ddx(Arguments a) {
  return floats<1>(a, [](Float x) { return footprint_derivative(x, 0); });
}
std::optional<Value> ddy(Arguments a) {
  return floats<1>(a, [](Float x) { return footprint_derivative(x, 1); });
}
std::optional<Value> glsl_fwidth(Arguments a) {
  return floats<1>(
      a, [](Float x) { return abs(footprint_derivative(x, 0)) + abs(footprint_derivative(x, 1)); });
}

constexpr std::array<std::pair<std::string_view, Builtin>, 65> builtins{{
    {"abs", glsl_abs},
    {"acos", each<acos>},
    {"all", glsl_all},
    {"any", glsl_any},
    {"asin", each<asin>},
    {"atan", glsl_atan},
    {"ceil", each<ceil>},
    {"clamp", glsl_clamp},
    {"cos", each<cos>},
    {"cosh", glsl_cosh},
    {"cross", glsl_cross},
    {"dFdx", ddx},
    {"dFdy", ddy},
    {"degrees", glsl_degrees},
    {"determinant", matrix::determinant},
    {"distance", glsl_distance},
    {"dot", glsl_dot},
    {"equal", glsl_equal},
    {"exp", each<exp>},
    {"exp2", each<exp2>},
    {"faceforward", glsl_faceforward},
    {"floatBitsToInt", float_bits_to_int},
    {"floatBitsToUint", float_bits_to_uint},
    {"floor", each<floor>},
    {"fma", glsl_fma},
    {"fract", each<fract>},
    {"fwidth", glsl_fwidth},
    {"greaterThan", greater_than},
    {"greaterThanEqual", greater_than_equal},
    {"intBitsToFloat", bits_to_float},
    {"inverse", matrix::inverse},
    {"inversesqrt", glsl_inversesqrt},
    {"isinf", glsl_isinf},
    {"isnan", glsl_isnan},
    {"length", glsl_length},
    {"lessThan", less_than},
    {"lessThanEqual", less_than_equal},
    {"log", each<log>},
    {"log2", each<log2>},
    {"matrixCompMult", matrix::matrix_comp_mult},
    {"max", glsl_max},
    {"min", glsl_min},
    {"mix", glsl_mix},
    {"mod", glsl_mod},
    {"normalize", glsl_normalize},
    {"not", glsl_not},
    {"notEqual", not_equal},
    {"outerProduct", matrix::outer_product},
    {"pow", glsl_pow},
    {"radians", glsl_radians},
    {"reflect", glsl_reflect},
    {"refract", glsl_refract},
    {"round", each<round>},
    {"roundEven", each<round>},
    {"sign", glsl_sign},
    {"sin", each<sin>},
    {"sinh", glsl_sinh},
    {"smoothstep", glsl_smoothstep},
    {"sqrt", each<sqrt>},
    {"step", glsl_step},
    {"tan", each<tan>},
    {"tanh", glsl_tanh},
    {"transpose", matrix::transpose},
    {"trunc", each<trunc>},
    {"uintBitsToFloat", bits_to_float},
}};

Builtin find(std::string_view name) {
  for (const auto& [candidate, function] : builtins) {
    if (candidate == name) return function;
  }
  return nullptr;
}

}  // namespace

BuiltinResult call_builtin(std::string_view name, std::span<const Value> arguments) {
  const Builtin function = find(name);
  if (function == nullptr) return {};
  if (arguments.empty()) return {true, none};
  return {true, function(arguments)};
}

bool is_builtin(std::string_view name) { return find(name) != nullptr; }

}  // namespace nacre::glsl
