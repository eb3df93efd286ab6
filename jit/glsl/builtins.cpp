#include "jit/glsl/builtins.h"

#include <array>
#include <utility>

#include "jit/glsl/componentwise.h"
#include "jit/glsl/matrix.h"
#include "jit/glsl/number_functions.h"
#include "jit/glsl/vector_functions.h"

namespace nacre::glsl {

namespace {

using Builtin = std::optional<Value> (*)(Arguments);

template <Float (*f)(Float)>
std::optional<Value> each(Arguments a) {
  return floats<1>(a, f);
}

constexpr std::array<std::pair<std::string_view, Builtin>, 65> builtins{{
    {"abs", number::glsl_abs},
    {"acos", each<acos>},
    {"all", vector::glsl_all},
    {"any", vector::glsl_any},
    {"asin", each<asin>},
    {"atan", number::glsl_atan},
    {"ceil", each<ceil>},
    {"clamp", number::glsl_clamp},
    {"cos", each<cos>},
    {"cosh", number::glsl_cosh},
    {"cross", vector::glsl_cross},
    {"dFdx", number::ddx},
    {"dFdy", number::ddy},
    {"degrees", number::glsl_degrees},
    {"determinant", matrix::determinant},
    {"distance", vector::glsl_distance},
    {"dot", vector::glsl_dot},
    {"equal", vector::glsl_equal},
    {"exp", each<exp>},
    {"exp2", each<exp2>},
    {"faceforward", vector::glsl_faceforward},
    {"floatBitsToInt", number::float_bits_to_int},
    {"floatBitsToUint", number::float_bits_to_uint},
    {"floor", each<floor>},
    {"fma", number::glsl_fma},
    {"fract", each<fract>},
    {"fwidth", number::glsl_fwidth},
    {"greaterThan", vector::greater_than},
    {"greaterThanEqual", vector::greater_than_equal},
    {"intBitsToFloat", number::bits_to_float},
    {"inverse", matrix::inverse},
    {"inversesqrt", number::glsl_inversesqrt},
    {"isinf", number::glsl_isinf},
    {"isnan", number::glsl_isnan},
    {"length", vector::glsl_length},
    {"lessThan", vector::less_than},
    {"lessThanEqual", vector::less_than_equal},
    {"log", each<log>},
    {"log2", each<log2>},
    {"matrixCompMult", matrix::matrix_comp_mult},
    {"max", number::glsl_max},
    {"min", number::glsl_min},
    {"mix", number::glsl_mix},
    {"mod", number::glsl_mod},
    {"normalize", vector::glsl_normalize},
    {"not", vector::glsl_not},
    {"notEqual", vector::not_equal},
    {"outerProduct", matrix::outer_product},
    {"pow", number::glsl_pow},
    {"radians", number::glsl_radians},
    {"reflect", vector::glsl_reflect},
    {"refract", vector::glsl_refract},
    {"round", each<round>},
    {"roundEven", each<round>},
    {"sign", number::glsl_sign},
    {"sin", each<sin>},
    {"sinh", number::glsl_sinh},
    {"smoothstep", number::glsl_smoothstep},
    {"sqrt", each<sqrt>},
    {"step", number::glsl_step},
    {"tan", each<tan>},
    {"tanh", number::glsl_tanh},
    {"transpose", matrix::transpose},
    {"trunc", each<trunc>},
    {"uintBitsToFloat", number::bits_to_float},
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
  if (arguments.empty()) return {true, std::nullopt};
  return {true, function(arguments)};
}

bool is_builtin(std::string_view name) { return find(name) != nullptr; }

}  // namespace nacre::glsl
