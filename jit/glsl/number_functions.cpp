#include "jit/glsl/number_functions.h"

namespace nacre::glsl::number {

namespace {

constexpr auto none = std::nullopt;
constexpr double pi = 3.14159265358979323846;

}  // namespace

// -- 8.1, 8.2: angles, trigonometry, exponentials

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
namespace {

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

}  // namespace

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

namespace {

std::optional<Value> to_bits(Arguments a, Base base) {
  if (a.size() != 1 || !a[0].type.is_float() || a[0].type.is_matrix()) return none;
  Value result{a[0].type.with_base(base), {}, {}};
  for (std::size_t i = 0; i < a[0].parts.size(); ++i) {
    result.parts.push_back(bits_of(a[0].number(i)).ref());
  }
  return result;
}

}  // namespace

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
namespace {

template <class F>
std::optional<Value> classify(Arguments a, F&& f) {
  if (a.size() != 1 || !a[0].type.is_float() || a[0].type.is_matrix()) return none;
  Value result{a[0].type.with_base(Base::boolean), {}, {}};
  for (std::size_t i = 0; i < a[0].parts.size(); ++i) {
    result.parts.push_back(f(a[0].number(i)).ref());
  }
  return result;
}

}  // namespace

std::optional<Value> glsl_isnan(Arguments a) {
  return classify(a, [](Float x) { return is_nan(x); });
}
std::optional<Value> glsl_isinf(Arguments a) {
  return classify(a, [](Float x) { return abs(x) > Float(3.402823466e38f); });
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

}  // namespace nacre::glsl::number
