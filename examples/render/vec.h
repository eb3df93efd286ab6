#pragma once

#include <algorithm>
#include <cmath>

/// \file
/// The few vectors a host needs between file, ray and film.
namespace nacre::host {

struct Vec2 {
  float x = 0.f, y = 0.f;
};

struct Vec3 {
  float x = 0.f, y = 0.f, z = 0.f;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(float s, Vec2 a) { return {s * a.x, s * a.y}; }

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(float s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
inline Vec3& operator*=(Vec3& a, Vec3 b) { return a = a * b; }

inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline float max_component(Vec3 a) { return std::max(a.x, std::max(a.y, a.z)); }
/// Each component to [0, 1]; NaN becomes 0.
inline Vec3 clamp_unit(Vec3 a) {
  const auto f = [](float v) { return v >= 0.f ? std::min(v, 1.f) : 0.f; };
  return {f(a.x), f(a.y), f(a.z)};
}
inline bool is_zero(Vec3 a) { return a.x == 0.f && a.y == 0.f && a.z == 0.f; }
inline bool is_finite(Vec3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

/// Unit vector along `a`, or `otherwise` when `a` has no direction.
inline Vec3 normalize_or(Vec3 a, Vec3 otherwise) {
  const float scale = std::max(std::abs(a.x), std::max(std::abs(a.y), std::abs(a.z)));
  if (!(scale > 0.f) || !std::isfinite(scale)) return otherwise;
  const Vec3 s = {a.x / scale, a.y / scale, a.z / scale};  // no overflow, no underflow
  return (1.f / length(s)) * s;
}
inline Vec3 normalize(Vec3 a) { return normalize_or(a, {0.f, 0.f, 1.f}); }

/// Rec. 709 luminance weights (ITU-R BT.709-6, item 3.2).
inline float luminance(Vec3 rgb) { return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z; }

/// A unit vector perpendicular to the unit vector `n`, without branches on axes.
/// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1).
inline Vec3 perpendicular(Vec3 n) {
  const float sign = std::copysign(1.f, n.z);
  const float a = -1.f / (sign + n.z);
  return {1.f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

/// Affine map of column vectors: p -> (x y z) p + origin.
struct Affine {
  Vec3 x = {1.f, 0.f, 0.f}, y = {0.f, 1.f, 0.f}, z = {0.f, 0.f, 1.f}, origin = {};
};

inline Vec3 transform_vector(const Affine& m, Vec3 v) { return v.x * m.x + v.y * m.y + v.z * m.z; }
inline Vec3 transform_point(const Affine& m, Vec3 p) { return transform_vector(m, p) + m.origin; }
inline float determinant(const Affine& m) { return dot(m.x, cross(m.y, m.z)); }

/// Transpose of the linear part times v. With m = world_to_object this takes a
/// normal from object to world, and the other way round.
inline Vec3 transform_normal(const Affine& inverse, Vec3 n) {
  return {dot(inverse.x, n), dot(inverse.y, n), dot(inverse.z, n)};
}

inline Affine operator*(const Affine& a, const Affine& b) {
  return {transform_vector(a, b.x), transform_vector(a, b.y), transform_vector(a, b.z),
          transform_point(a, b.origin)};
}

/// The inverse; a singular map gives non-finite entries.
inline Affine inverse(const Affine& m) {
  const float d = 1.f / determinant(m);
  const Vec3 r0 = d * cross(m.y, m.z);
  const Vec3 r1 = d * cross(m.z, m.x);
  const Vec3 r2 = d * cross(m.x, m.y);
  Affine i = {{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {}};
  i.origin = -transform_vector(i, m.origin);
  return i;
}

}  // namespace nacre::host
