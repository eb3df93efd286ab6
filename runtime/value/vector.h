#pragma once

#include "runtime/value/value.h"

namespace nacre {

/// @file
/// Recorded vectors and colours: plain groups of scalars. A colour is linear
/// in the document's working space unless a declaration says otherwise.

/// Two recorded floats.
struct Float2 {
  /// In this order.
  /// @{
  Float x, y;
  /// @}
};
/// Three recorded floats, a vector3 or color3.
struct Float3 {
  /// In this order; red, green, blue of a colour.
  /// @{
  Float x, y, z;
  /// @}
  /// Zeros.
  Float3() = default;
  /// The same in all components.
  Float3(Float all) : x(all), y(all), z(all) {}
  /// One by one.
  Float3(Float x_, Float y_, Float z_) : x(x_), y(y_), z(z_) {}
};
/// Four recorded floats, a vector4 or color4.
struct Float4 {
  /// In this order; red, green, blue, alpha of a colour.
  /// @{
  Float x, y, z, w;
  /// @}
};
/// For people: engines see no difference.
using Color3 = Float3;
/// For people: engines see no difference.
using Color4 = Float4;

/// Calls f on every scalar of v, in order. Structures of recorded values that cross an
/// if_any, a loop or an outlined function define their own.
/// @{
template <class F>
void visit(Float& v, F&& f) {
  f(v);
}
template <class F>
void visit(Int& v, F&& f) {
  f(v);
}
template <class F>
void visit(Bool& v, F&& f) {
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

// -- Float2 -----------------------------------------------------------------

/// Component by component; s stands for both.
/// @{
inline Float2 operator+(Float2 a, Float2 b) { return {a.x + b.x, a.y + b.y}; }
inline Float2 operator-(Float2 a, Float2 b) { return {a.x - b.x, a.y - b.y}; }
inline Float2 operator*(Float2 a, Float2 b) { return {a.x * b.x, a.y * b.y}; }
inline Float2 operator*(Float2 a, Float s) { return {a.x * s, a.y * s}; }
inline Float2 operator*(Float s, Float2 a) { return {s * a.x, s * a.y}; }
/// @}
/// a.x b.x + a.y b.y, the addition fused.
inline Float dot(Float2 a, Float2 b) { return fma(a.x, b.x, a.y * b.y); }

// -- Float3 -----------------------------------------------------------------

/// Component by component.
/// @{
inline Float3 operator+(Float3 a, Float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Float3 operator-(Float3 a, Float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float3 operator*(Float3 a, Float3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Float3 operator/(Float3 a, Float3 b) { return {a.x / b.x, a.y / b.y, a.z / b.z}; }
inline Float3 operator-(Float3 a) { return {-a.x, -a.y, -a.z}; }
inline Float3& operator+=(Float3& a, Float3 b) { return a = a + b; }
inline Float3& operator*=(Float3& a, Float3 b) { return a = a * b; }
/// @}

/// a.x b.x + a.y b.y + a.z b.z, two of the additions fused.
inline Float dot(Float3 a, Float3 b) { return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z)); }
/// Each component with one product fused; the sum of one with itself need not be 0 exactly.
inline Float3 cross(Float3 a, Float3 b) {
  return {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))};
}
/// Component by component, each rounded once.
inline Float3 fma(Float3 a, Float3 b, Float3 c) {
  return {fma(a.x, b.x, c.x), fma(a.y, b.y, c.y), fma(a.z, b.z, c.z)};
}
/// sqrt(dot(v, v)): infinite from about 1.8e19 on, 0 below about 1e-19.
inline Float length(Float3 v) { return sqrt(dot(v, v)); }
/// v / |v|; zero where v is zero, or so short that |v|^2 is denormal.
inline Float3 normalize(Float3 v) {
  const Float squared = dot(v, v);
  const Float scale = select(squared > 0.0f, 1.0f / sqrt(squared), 0.0f);
  return v * Float3(scale);
}
/// Component by component, as the function of scalars.
/// @{
inline Float3 lerp(Float3 a, Float3 b, Float t) {
  return {lerp(a.x, b.x, t), lerp(a.y, b.y, t), lerp(a.z, b.z, t)};
}
inline Float3 select(Bool c, Float3 a, Float3 b) {
  return {select(c, a.x, b.x), select(c, a.y, b.y), select(c, a.z, b.z)};
}
inline Float3 min(Float3 a, Float3 b) { return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)}; }
inline Float3 max(Float3 a, Float3 b) { return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)}; }
inline Float3 sqrt(Float3 a) { return {sqrt(a.x), sqrt(a.y), sqrt(a.z)}; }
inline Float3 saturate(Float3 a) { return {saturate(a.x), saturate(a.y), saturate(a.z)}; }
/// @}
/// The largest; NaN only where the last one is.
inline Float max_component(Float3 a) { return max(max(a.x, a.y), a.z); }
/// Mean of the components.
inline Float average(Float3 a) { return (a.x + a.y + a.z) * Float(1.0f / 3.0f); }
/// Every component a literal zero: nothing to record for it.
inline bool is_zero(Float3 a) {
  return a.x.is_constant(0.0f) && a.y.is_constant(0.0f) && a.z.is_constant(0.0f);
}
/// Whether both are one recorded value or literal: the same without a look at any number.
inline bool same_value(Ref a, Ref b) {
  return a.recorder == b.recorder && a.id == b.id && a.type == b.type;
}
inline bool same_value(Float3 a, Float3 b) {
  return same_value(a.x.ref(), b.x.ref()) && same_value(a.y.ref(), b.y.ref()) &&
         same_value(a.z.ref(), b.z.ref());
}
/// s a, but nothing at all where s is a literal 0 (a weight that is off skips
/// what it weighs, infinities included).
inline Float3 weigh(Float s, Float3 a) {
  return s.is_constant(0.0f) ? Float3(0.0f) : Float3(s) * a;
}

}  // namespace nacre
