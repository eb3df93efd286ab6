#pragma once

#include <bit>
#include <cstdint>

#include "runtime/value/ref.h"

namespace nacre {

/// @file
/// Recorded scalars. They look like float, int and bool: arithmetic on them
/// records operations (runtime/program/op.h says what each means), and on
/// literals computes at once, so a body may ask what is_constant() and record
/// nothing for what is not needed.

/// A recorded truth value.
class Bool {
 public:
  /// A literal.
  Bool(bool value = false) : ref_(Ref::literal(value)) {}
  /// A recorded b1.
  explicit Bool(Ref ref) : ref_(ref) {}
  /// For the Recorder.
  Ref ref() const { return ref_; }
  /// It is a literal.
  bool is_constant() const { return ref_.is_constant(); }
  /// It is the literal `value`.
  bool is_constant(bool value) const { return ref_.is_constant(value ? 1u : 0u); }

 private:
  Ref ref_;
};

/// A recorded integer of 32 bits; operations wrap.
class Int {
 public:
  /// A literal.
  Int(std::int32_t value = 0) : ref_(Ref::literal(value)) {}
  /// A recorded i32.
  explicit Int(Ref ref) : ref_(ref) {}
  /// For the Recorder.
  Ref ref() const { return ref_; }
  /// It is a literal.
  bool is_constant() const { return ref_.is_constant(); }
  /// It is the literal `value`.
  bool is_constant(std::int32_t value) const {
    return ref_.is_constant(static_cast<std::uint32_t>(value));
  }
  /// The literal's value; only where is_constant().
  std::int32_t constant() const { return static_cast<std::int32_t>(ref_.id); }

 private:
  Ref ref_;
};

/// A recorded float, never denormal.
class Float {
 public:
  /// A literal, rounded to float.
  /// @{
  Float(float value = 0.0f) : ref_(Ref::literal(value)) {}
  Float(double value) : Float(static_cast<float>(value)) {}
  Float(int value) : Float(static_cast<float>(value)) {}
  /// @}
  /// A recorded f32.
  explicit Float(Ref ref) : ref_(ref) {}
  /// For the Recorder.
  Ref ref() const { return ref_; }
  /// It is a literal.
  bool is_constant() const { return ref_.is_constant(); }
  /// It is a literal that equals `value`: either zero is 0, and NaN nothing.
  bool is_constant(float value) const { return is_constant() && constant() == value; }
  /// The literal's value; only where is_constant().
  float constant() const { return std::bit_cast<float>(ref_.id); }

 private:
  Ref ref_;
};

// -- Float ------------------------------------------------------------------

/// As Op::add, sub, mul, div and neg; a product that only goes into a sum is fused with it.
/// @{
inline Float operator+(Float a, Float b) { return Float(record(Op::add, {a.ref(), b.ref()})); }
inline Float operator-(Float a, Float b) { return Float(record(Op::sub, {a.ref(), b.ref()})); }
inline Float operator*(Float a, Float b) { return Float(record(Op::mul, {a.ref(), b.ref()})); }
inline Float operator/(Float a, Float b) { return Float(record(Op::div, {a.ref(), b.ref()})); }
inline Float operator-(Float a) { return Float(record(Op::neg, {a.ref()})); }
inline Float& operator+=(Float& a, Float b) { return a = a + b; }
inline Float& operator-=(Float& a, Float b) { return a = a - b; }
inline Float& operator*=(Float& a, Float b) { return a = a * b; }
inline Float& operator/=(Float& a, Float b) { return a = a / b; }
/// @}

/// All but != are false where either is NaN.
/// @{
inline Bool operator==(Float a, Float b) { return Bool(record(Op::eq, {a.ref(), b.ref()})); }
inline Bool operator!=(Float a, Float b) { return Bool(record(Op::ne, {a.ref(), b.ref()})); }
inline Bool operator<(Float a, Float b) { return Bool(record(Op::lt, {a.ref(), b.ref()})); }
inline Bool operator<=(Float a, Float b) { return Bool(record(Op::le, {a.ref(), b.ref()})); }
inline Bool operator>(Float a, Float b) { return b < a; }
inline Bool operator>=(Float a, Float b) { return b <= a; }
/// @}

/// a * b + c, rounded once.
inline Float fma(Float a, Float b, Float c) {
  return Float(record(Op::fma, {a.ref(), b.ref(), c.ref()}));
}
/// a < b ? a : b; b where either is NaN.
inline Float min(Float a, Float b) { return Float(record(Op::min, {a.ref(), b.ref()})); }
/// a > b ? a : b; b where either is NaN.
inline Float max(Float a, Float b) { return Float(record(Op::max, {a.ref(), b.ref()})); }
/// Rounded once; NaN below zero.
inline Float sqrt(Float x) { return Float(record(Op::sqrt, {x.ref()})); }
/// Without the sign bit.
inline Float abs(Float x) { return Float(record(Op::abs, {x.ref()})); }
/// Down, up and toward zero; infinities and NaN pass.
/// @{
inline Float floor(Float x) { return Float(record(Op::floor, {x.ref()})); }
inline Float ceil(Float x) { return Float(record(Op::ceil, {x.ref()})); }
inline Float trunc(Float x) { return Float(record(Op::trunc, {x.ref()})); }
/// @}
/// To nearest, ties to even.
inline Float round(Float x) { return Float(record(Op::round, {x.ref()})); }

/// As in the C library, angles in radians; CompileOptions::accuracy says how exact.
/// @{
inline Float sin(Float x) { return Float(record(Op::sin, {x.ref()})); }
inline Float cos(Float x) { return Float(record(Op::cos, {x.ref()})); }
inline Float tan(Float x) { return Float(record(Op::tan, {x.ref()})); }
inline Float asin(Float x) { return Float(record(Op::asin, {x.ref()})); }
inline Float acos(Float x) { return Float(record(Op::acos, {x.ref()})); }
inline Float atan2(Float y, Float x) { return Float(record(Op::atan2, {y.ref(), x.ref()})); }
inline Float exp(Float x) { return Float(record(Op::exp, {x.ref()})); }
inline Float exp2(Float x) { return Float(record(Op::exp2, {x.ref()})); }
inline Float log(Float x) { return Float(record(Op::log, {x.ref()})); }
inline Float log2(Float x) { return Float(record(Op::log2, {x.ref()})); }
inline Float pow(Float x, Float y) { return Float(record(Op::pow, {x.ref(), y.ref()})); }
/// @}

/// Derivative along an axis (0: x, 1: y) of the shading point's footprint.
inline Float footprint_derivative(Float x, int axis) {
  return Float(record(Op::ddx, {x.ref()}, static_cast<std::uint32_t>(axis)));
}

/// `x`, with the derivatives of `y`.
inline Float stand_in(Float x, Float y) { return Float(record(Op::stand_in, {x.ref(), y.ref()})); }

// -- Int --------------------------------------------------------------------

/// Modulo 2^32, on two's complement.
/// @{
inline Int operator+(Int a, Int b) { return Int(record(Op::iadd, {a.ref(), b.ref()})); }
inline Int operator-(Int a, Int b) { return Int(record(Op::isub, {a.ref(), b.ref()})); }
inline Int operator*(Int a, Int b) { return Int(record(Op::imul, {a.ref(), b.ref()})); }
inline Int operator-(Int a) { return Int(0) - a; }
inline Int operator&(Int a, Int b) { return Int(record(Op::iand, {a.ref(), b.ref()})); }
inline Int operator|(Int a, Int b) { return Int(record(Op::ior, {a.ref(), b.ref()})); }
inline Int operator^(Int a, Int b) { return Int(record(Op::ixor, {a.ref(), b.ref()})); }
/// @}
/// By the low five bits of b.
inline Int operator<<(Int a, Int b) { return Int(record(Op::shl, {a.ref(), b.ref()})); }
/// By the low five bits of b; shifts the sign in.
inline Int operator>>(Int a, Int b) { return Int(record(Op::ashr, {a.ref(), b.ref()})); }
/// By the low five bits of b; shifts zeros in.
inline Int shift_right_logical(Int a, Int b) { return Int(record(Op::lshr, {a.ref(), b.ref()})); }
/// High half of the unsigned 64-bit product.
inline Int multiply_high(Int a, Int b) { return Int(record(Op::umulhi, {a.ref(), b.ref()})); }

/// Signed.
/// @{
inline Bool operator==(Int a, Int b) { return Bool(record(Op::ieq, {a.ref(), b.ref()})); }
inline Bool operator<(Int a, Int b) { return Bool(record(Op::ilt, {a.ref(), b.ref()})); }
inline Bool operator>(Int a, Int b) { return b < a; }
/// @}
/// a < b of the unsigned numbers with these bits.
inline Bool less_unsigned(Int a, Int b) { return Bool(record(Op::ult, {a.ref(), b.ref()})); }

// -- Bool -------------------------------------------------------------------

/// Both sides are always computed.
/// @{
inline Bool operator&(Bool a, Bool b) { return Bool(record(Op::band, {a.ref(), b.ref()})); }
inline Bool operator|(Bool a, Bool b) { return Bool(record(Op::bor, {a.ref(), b.ref()})); }
inline Bool operator^(Bool a, Bool b) { return Bool(record(Op::bxor, {a.ref(), b.ref()})); }
inline Bool operator!(Bool a) { return Bool(record(Op::bnot, {a.ref()})); }
/// @}
/// Signed.
/// @{
inline Bool operator!=(Int a, Int b) { return !(a == b); }
inline Bool operator<=(Int a, Int b) { return !(b < a); }
inline Bool operator>=(Int a, Int b) { return !(a < b); }
/// @}

/// a where the condition holds, else b. Both are computed, but nothing of the other, be it
/// NaN or infinite, gets into the result.
/// @{
inline Float select(Bool condition, Float a, Float b) {
  return Float(record(Op::select, {condition.ref(), a.ref(), b.ref()}));
}
inline Int select(Bool condition, Int a, Int b) {
  return Int(record(Op::select, {condition.ref(), a.ref(), b.ref()}));
}
inline Bool select(Bool condition, Bool a, Bool b) {
  return Bool(record(Op::select, {condition.ref(), a.ref(), b.ref()}));
}
/// @}
/// Signed.
inline Int min(Int a, Int b) { return select(a < b, a, b); }
/// Signed.
inline Int max(Int a, Int b) { return select(a > b, a, b); }

// -- Conversions ------------------------------------------------------------

/// Toward zero, clamped to the range of int; NaN gives 0.
inline Int to_int(Float x) { return Int(record(Op::f_to_i, {x.ref()})); }
/// Signed, to nearest even.
inline Float to_float(Int x) { return Float(record(Op::i_to_f, {x.ref()})); }
/// The unsigned number with these bits, to nearest even.
inline Float to_float_unsigned(Int x) { return Float(record(Op::u_to_f, {x.ref()})); }
/// 1 where true, else 0.
inline Int to_int(Bool x) { return Int(record(Op::b_to_i, {x.ref()})); }
/// 1 where true, else 0.
inline Float to_float(Bool x) { return select(x, Float(1.0f), Float(0.0f)); }
/// The bits of x, every NaN as 0x7fc00000.
inline Int bits_of(Float x) { return Int(record(Op::bits, {x.ref()})); }
/// The float of those bits, denormals as zero.
inline Float float_of_bits(Int x) { return Float(record(Op::from_bits, {x.ref()})); }
/// The binary16 in the low 16 bits.
inline Float half_to_float(Int x) { return Float(record(Op::half_to_f, {x.ref()})); }

// -- Small functions that every body wants ------------------------------------

/// (1 - t) a + t b in two fma; exact at t = 0, and at t = 1 to rounding.
inline Float lerp(Float a, Float b, Float t) { return fma(t, b, fma(-t, a, a)); }
/// min(max(x, low), high), so low where x is NaN.
inline Float clamp(Float x, Float low, Float high) { return min(max(x, low), high); }
/// x clamped to [0, 1]; 0 where it is NaN.
inline Float saturate(Float x) { return clamp(x, 0.0f, 1.0f); }
/// x x, which is 0 below about 1e-19.
inline Float square(Float x) { return x * x; }
/// x - floor(x), in [0, 1].
inline Float fract(Float x) { return x - floor(x); }
/// sqrt of max(x, 0), so 0 below zero and for NaN.
inline Float safe_sqrt(Float x) { return sqrt(max(x, 0.0f)); }
/// |x| with the sign bit of s.
inline Float copysign(Float x, Float s) {
  return float_of_bits((bits_of(abs(x))) | (bits_of(s) & Int(INT32_MIN)));
}
/// True for NaN, whatever its bits.
inline Bool is_nan(Float x) { return x != x; }

}  // namespace nacre
