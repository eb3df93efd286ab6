/// \file
/// Recorded values that look like floats: part of <nacre/nacre.hpp>.
#ifndef NACRE_VALUES_HPP
#define NACRE_VALUES_HPP

#include <nacre/nacre.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace nacre {
inline namespace v0 {

/// A recorded truth value, integer or float. A literal until something that differs from point to
/// point comes in; operations on literals are computed at once, so a body may ask is_constant()
/// and record nothing for what is not needed.
/// @{
class Bool {
 public:
  Bool(bool value = false) : value_(nacre_literal_bool(value)) {}
  explicit Bool(nacre_value value) : value_(value) {}
  nacre_value value() const { return value_; }
  bool is_constant() const { return value_.recorder == nullptr; }
  bool is_constant(bool value) const { return is_constant() && (value_.bits != 0) == value; }

 private:
  nacre_value value_;
};

class Int {
 public:
  Int(std::int32_t value = 0) : value_(nacre_literal_int(value)) {}
  explicit Int(nacre_value value) : value_(value) {}
  nacre_value value() const { return value_; }
  bool is_constant() const { return value_.recorder == nullptr; }
  /// Only where is_constant().
  std::int32_t constant() const { return static_cast<std::int32_t>(value_.bits); }

 private:
  nacre_value value_;
};

class Float {
 public:
  Float(float value = 0.0f) : value_(nacre_literal_float(value)) {}
  Float(double value) : Float(static_cast<float>(value)) {}
  Float(int value) : Float(static_cast<float>(value)) {}
  explicit Float(nacre_value value) : value_(value) {}
  nacre_value value() const { return value_; }
  bool is_constant() const { return value_.recorder == nullptr; }
  bool is_constant(float value) const { return is_constant() && constant() == value; }
  /// Only where is_constant().
  float constant() const {
    float number = 0;
    std::memcpy(&number, &value_.bits, sizeof number);
    return number;
  }

 private:
  nacre_value value_;
};
/// @}

namespace detail {
template <class... Values>
nacre_value record(nacre_operation operation, std::uint32_t immediate, Values... values) {
  const nacre_value operands[]{values.value()...};
  return nacre_record(operation, operands, sizeof...(values), immediate);
}
}  // namespace detail

/// As nacre_operation says.
/// @{
inline Float operator+(Float a, Float b) { return Float(detail::record(NACRE_ADD, 0, a, b)); }
inline Float operator-(Float a, Float b) { return Float(detail::record(NACRE_SUB, 0, a, b)); }
inline Float operator*(Float a, Float b) { return Float(detail::record(NACRE_MUL, 0, a, b)); }
inline Float operator/(Float a, Float b) { return Float(detail::record(NACRE_DIV, 0, a, b)); }
inline Float operator-(Float a) { return Float(detail::record(NACRE_NEG, 0, a)); }
inline Float& operator+=(Float& a, Float b) { return a = a + b; }
inline Float& operator-=(Float& a, Float b) { return a = a - b; }
inline Float& operator*=(Float& a, Float b) { return a = a * b; }
inline Float& operator/=(Float& a, Float b) { return a = a / b; }
inline Bool operator==(Float a, Float b) { return Bool(detail::record(NACRE_EQ, 0, a, b)); }
inline Bool operator!=(Float a, Float b) { return Bool(detail::record(NACRE_NE, 0, a, b)); }
inline Bool operator<(Float a, Float b) { return Bool(detail::record(NACRE_LT, 0, a, b)); }
inline Bool operator<=(Float a, Float b) { return Bool(detail::record(NACRE_LE, 0, a, b)); }
inline Bool operator>(Float a, Float b) { return b < a; }
inline Bool operator>=(Float a, Float b) { return b <= a; }
inline Float fma(Float a, Float b, Float c) { return Float(detail::record(NACRE_FMA, 0, a, b, c)); }
inline Float min(Float a, Float b) { return Float(detail::record(NACRE_MIN, 0, a, b)); }
inline Float max(Float a, Float b) { return Float(detail::record(NACRE_MAX, 0, a, b)); }
inline Float sqrt(Float x) { return Float(detail::record(NACRE_SQRT, 0, x)); }
inline Float abs(Float x) { return Float(detail::record(NACRE_ABS, 0, x)); }
inline Float floor(Float x) { return Float(detail::record(NACRE_FLOOR, 0, x)); }
inline Float ceil(Float x) { return Float(detail::record(NACRE_CEIL, 0, x)); }
inline Float trunc(Float x) { return Float(detail::record(NACRE_TRUNC, 0, x)); }
inline Float round(Float x) { return Float(detail::record(NACRE_ROUND, 0, x)); }
inline Float sin(Float x) { return Float(detail::record(NACRE_SIN, 0, x)); }
inline Float cos(Float x) { return Float(detail::record(NACRE_COS, 0, x)); }
inline Float tan(Float x) { return Float(detail::record(NACRE_TAN, 0, x)); }
inline Float asin(Float x) { return Float(detail::record(NACRE_ASIN, 0, x)); }
inline Float acos(Float x) { return Float(detail::record(NACRE_ACOS, 0, x)); }
inline Float atan2(Float y, Float x) { return Float(detail::record(NACRE_ATAN2, 0, y, x)); }
inline Float exp(Float x) { return Float(detail::record(NACRE_EXP, 0, x)); }
inline Float exp2(Float x) { return Float(detail::record(NACRE_EXP2, 0, x)); }
inline Float log(Float x) { return Float(detail::record(NACRE_LOG, 0, x)); }
inline Float log2(Float x) { return Float(detail::record(NACRE_LOG2, 0, x)); }
inline Float pow(Float x, Float y) { return Float(detail::record(NACRE_POW, 0, x, y)); }
/// Along an axis (0: x, 1: y) of the point's footprint.
inline Float footprint_derivative(Float x, int axis) {
  return Float(detail::record(NACRE_DERIVATIVE, static_cast<std::uint32_t>(axis), x));
}

inline Int operator+(Int a, Int b) { return Int(detail::record(NACRE_IADD, 0, a, b)); }
inline Int operator-(Int a, Int b) { return Int(detail::record(NACRE_ISUB, 0, a, b)); }
inline Int operator*(Int a, Int b) { return Int(detail::record(NACRE_IMUL, 0, a, b)); }
inline Int operator-(Int a) { return Int(0) - a; }
inline Int operator&(Int a, Int b) { return Int(detail::record(NACRE_IAND, 0, a, b)); }
inline Int operator|(Int a, Int b) { return Int(detail::record(NACRE_IOR, 0, a, b)); }
inline Int operator^(Int a, Int b) { return Int(detail::record(NACRE_IXOR, 0, a, b)); }
inline Int operator<<(Int a, Int b) { return Int(detail::record(NACRE_SHL, 0, a, b)); }
inline Int operator>>(Int a, Int b) { return Int(detail::record(NACRE_ASHR, 0, a, b)); }
inline Int shift_right_logical(Int a, Int b) { return Int(detail::record(NACRE_LSHR, 0, a, b)); }
inline Int multiply_high(Int a, Int b) { return Int(detail::record(NACRE_UMULHI, 0, a, b)); }
inline Bool operator==(Int a, Int b) { return Bool(detail::record(NACRE_IEQ, 0, a, b)); }
inline Bool operator<(Int a, Int b) { return Bool(detail::record(NACRE_ILT, 0, a, b)); }
inline Bool operator>(Int a, Int b) { return b < a; }
inline Bool less_unsigned(Int a, Int b) { return Bool(detail::record(NACRE_ULT, 0, a, b)); }

inline Bool operator&(Bool a, Bool b) { return Bool(detail::record(NACRE_AND, 0, a, b)); }
inline Bool operator|(Bool a, Bool b) { return Bool(detail::record(NACRE_OR, 0, a, b)); }
inline Bool operator^(Bool a, Bool b) { return Bool(detail::record(NACRE_XOR, 0, a, b)); }
inline Bool operator!(Bool a) { return Bool(detail::record(NACRE_NOT, 0, a)); }

inline Int to_int(Float x) { return Int(detail::record(NACRE_F_TO_I, 0, x)); }
inline Float to_float(Int x) { return Float(detail::record(NACRE_I_TO_F, 0, x)); }
inline Float unsigned_to_float(Int x) { return Float(detail::record(NACRE_U_TO_F, 0, x)); }
inline Int bits(Float x) { return Int(detail::record(NACRE_BITS, 0, x)); }
inline Float from_bits(Int x) { return Float(detail::record(NACRE_FROM_BITS, 0, x)); }
inline Int to_int(Bool x) { return Int(detail::record(NACRE_B_TO_I, 0, x)); }
/// @}

/// Recorded vectors and colours.
/// @{
struct Float2 {
  Float x, y;
};
struct Float3 {
  Float x, y, z;
  Float3() = default;
  Float3(Float all) : x(all), y(all), z(all) {}
  Float3(Float x_, Float y_, Float z_) : x(x_), y(y_), z(z_) {}
};
struct Float4 {
  Float x, y, z, w;
};
/// @}

inline Float3 operator+(Float3 a, Float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Float3 operator-(Float3 a, Float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float3 operator*(Float3 a, Float3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Float3 operator-(Float3 a) { return {-a.x, -a.y, -a.z}; }
inline Float dot(Float3 a, Float3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
inline Float3 cross(Float3 a, Float3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Calls f on every scalar of v, in order. A structure of recorded values that crosses a select,
/// an if_any or a loop has one of its own, found by its namespace.
/// @{
template <class F>
void visit(Bool& v, F&& f) {
  f(v);
}
template <class F>
void visit(Int& v, F&& f) {
  f(v);
}
template <class F>
void visit(Float& v, F&& f) {
  f(v);
}
template <class F>
void visit(Float2& v, F&& f) {
  f(v.x), f(v.y);
}
template <class F>
void visit(Float3& v, F&& f) {
  f(v.x), f(v.y), f(v.z);
}
template <class F>
void visit(Float4& v, F&& f) {
  f(v.x), f(v.y), f(v.z), f(v.w);
}
/// @}

namespace detail {

template <class T>
std::vector<nacre_value> flatten(T value) {
  std::vector<nacre_value> list;
  visit(value, [&](auto& scalar) { list.push_back(scalar.value()); });
  return list;
}

/// `like` with its scalars replaced, in visit order.
template <class T>
T rebuild(T like, const std::vector<nacre_value>& list) {
  std::size_t next = 0;
  visit(like,
        [&](auto& scalar) { scalar = std::remove_reference_t<decltype(scalar)>(list[next++]); });
  return like;
}

}  // namespace detail

/// yes where the mask is true, no elsewhere; both sides are computed.
inline Float select(Bool mask, Float yes, Float no) {
  return Float(detail::record(NACRE_SELECT, 0, mask, yes, no));
}
inline Int select(Bool mask, Int yes, Int no) {
  return Int(detail::record(NACRE_SELECT, 0, mask, yes, no));
}
inline Bool select(Bool mask, Bool yes, Bool no) {
  return Bool(detail::record(NACRE_SELECT, 0, mask, yes, no));
}
template <class T>
T select(Bool mask, T yes, T no) {
  const std::vector<nacre_value> a = detail::flatten(yes);
  const std::vector<nacre_value> b = detail::flatten(no);
  std::vector<nacre_value> chosen;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const nacre_value operands[]{mask.value(), a[i], b[i]};
    chosen.push_back(nacre_record(NACRE_SELECT, operands, 3, 0));
  }
  return detail::rebuild(yes, chosen);
}

/// body() in the points where the mask is true, `otherwise` in the others; the body's work is
/// skipped where no point needs it.
template <class T, class F>
T if_any(Bool mask, T otherwise, F&& body) {
  if (mask.is_constant(true)) return body();
  if (mask.is_constant(false)) return otherwise;
  nacre_recorder* const recorder = mask.value().recorder;
  nacre_begin_if(recorder, mask.value());
  const std::vector<nacre_value> inner = detail::flatten(T(body()));
  const std::vector<nacre_value> outer = detail::flatten(otherwise);
  std::vector<nacre_value> merged;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    merged.push_back(nacre_merge(recorder, inner[i], outer[i]));
  }
  nacre_end_if(recorder);
  return detail::rebuild(otherwise, merged);
}

/// Repeats body(iteration, state) -> Bool at most `bound` times in the points where `active` is
/// true and every body so far returned true. The state each point had when it stopped.
template <class T, class F>
T loop(nacre_recorder* recorder, Bool active, int bound, T state, F&& body) {
  if (active.is_constant(false) || bound <= 0) return state;
  nacre_begin_loop(recorder, active.value(), static_cast<std::uint32_t>(bound));
  std::vector<nacre_value> carries;
  for (const nacre_value initial : detail::flatten(state)) {
    carries.push_back(nacre_carry(recorder, initial));
  }
  const nacre_value count = nacre_carry(recorder, Int(0).value());
  T inside = detail::rebuild(state, carries);
  const Bool goes_on = body(Int(count), inside);
  const nacre_value following = (Int(count) + Int(1)).value();
  const std::vector<nacre_value> values = detail::flatten(inside);
  std::vector<nacre_value> finals;
  for (std::size_t i = 0; i < values.size(); ++i) {
    finals.push_back(nacre_next(recorder, carries[i], values[i]));
  }
  nacre_next(recorder, count, following);
  nacre_again(recorder, goes_on.value());
  nacre_end_loop(recorder);
  return detail::rebuild(state, finals);
}

/// Marks what NACRE_BEGIN stores for the kernels after it.
template <class T>
T keep(nacre_recorder* recorder, T value) {
  std::vector<nacre_value> kept;
  for (const nacre_value each : detail::flatten(value)) kept.push_back(nacre_keep(recorder, each));
  return detail::rebuild(value, kept);
}

}  // namespace v0
}  // namespace nacre

#endif
