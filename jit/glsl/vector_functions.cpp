#include "jit/glsl/vector_functions.h"

#include "jit/glsl/operators.h"

namespace nacre::glsl::vector {

namespace {

constexpr auto none = std::nullopt;

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

}  // namespace

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

namespace {

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

}  // namespace

std::optional<Value> less_than(Arguments a) { return relation(a, "<"); }
std::optional<Value> less_than_equal(Arguments a) { return relation(a, "<="); }
std::optional<Value> greater_than(Arguments a) { return relation(a, ">"); }
std::optional<Value> greater_than_equal(Arguments a) { return relation(a, ">="); }
std::optional<Value> glsl_equal(Arguments a) { return relation(a, "=="); }
std::optional<Value> not_equal(Arguments a) { return relation(a, "!="); }

namespace {

std::optional<Value> any_or_all(Arguments a, bool all) {
  if (a.size() != 1 || a[0].type.base != Base::boolean || !a[0].type.is_vector()) return none;
  Bool result = a[0].truth(0);
  for (std::size_t i = 1; i < a[0].parts.size(); ++i) {
    result = all ? result & a[0].truth(i) : result | a[0].truth(i);
  }
  return make(result);
}

}  // namespace

std::optional<Value> glsl_any(Arguments a) { return any_or_all(a, false); }
std::optional<Value> glsl_all(Arguments a) { return any_or_all(a, true); }
std::optional<Value> glsl_not(Arguments a) {
  if (a.size() != 1 || a[0].type.base != Base::boolean || !a[0].type.is_vector()) return none;
  Value result = a[0];
  for (std::size_t i = 0; i < result.parts.size(); ++i) result.parts[i] = (!a[0].truth(i)).ref();
  return result;
}

}  // namespace nacre::glsl::vector
