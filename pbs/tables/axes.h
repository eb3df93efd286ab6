#pragma once

#include <cmath>

#include "runtime/value/value.h"

namespace nacre {

/// Where a view stands on the axes of the GGX tables, each in [0, 1]. Written
/// once for Float, which kernels look up with, and double, which make_tables.cpp
/// computes the nodes with.

namespace table_axes {

using std::sqrt;

inline double least(double a, double b) { return a < b ? a : b; }
inline double most(double a, double b) { return a < b ? b : a; }
inline Float least(Float a, Float b) { return min(a, b); }
inline Float most(Float a, Float b) { return max(a, b); }

/// [0, 1] onto itself, steep within `width` of 0.
template <class T>
T steep(T s, T width) {
  return s * (T(1.0) + width) / (s + width);
}

/// Roughness: the square root spreads smooth surfaces.
template <class T>
T roughness(T alpha) {
  return sqrt(alpha);
}

/// Angle, on the side of reflection: what masking does depends on cosine / alpha, and the rougher
/// the surface the more of it happens close to grazing.
template <class T>
T angle(T cosine, T alpha) {
  return steep(cosine, alpha / (T(1.0) + T(3.0) * alpha));
}

/// The same for what unequal roughness adds, which has two scales: those of roughness along the
/// view and across it.
template <class T>
T unequal_angle(T cosine, T along, T across) {
  return T(0.5) * (angle(cosine, along) + angle(cosine, across));
}

/// The same where light enters: near grazing Fresnel's factor falls within a tenth, however rough
/// the surface is.
template <class T>
T entering_angle(T cosine, T alpha) {
  return steep(cosine, alpha / (T(1.0) + T(9.0) * alpha));
}

/// The last of the indices, and the fourth root of its reflectance at normal incidence.
inline constexpr double last_index = 50.0;
inline constexpr double last_root = 0.98019605881960692;

/// Relative index from 1 up to the last, and the same below 1: the fourth root of the
/// reflectance at normal incidence.
template <class T>
T index(T eta) {
  const T offset = (eta - T(1.0)) / (eta + T(1.0));
  return least(sqrt(most(offset, -offset)) * T(1.0 / last_root), T(1.0));
}

/// Cosine of the critical angle of a relative index below 1; not quite 0 at 1.
template <class T>
T critical_cosine(T eta) {
  return sqrt(most((T(1.0) - eta) * (T(1.0) + eta), T(1e-6)));
}

/// Angle where total reflection is possible: the share [0, 0.6] of the axis lies
/// beyond the critical angle. Steep at grazing view and on both sides of it.
template <class T>
T beyond_critical(T cosine, T alpha, T critical) {
  const T scale = alpha / critical;
  const T width = scale * sqrt(most(T(1.0) - critical * critical, T(0.0)));
  const T s = least(cosine / critical, T(1.0));
  const T grazing = scale / (T(1.0) + T(3.0) * scale);
  return T(0.3) * (steep(s, grazing) + T(1.0) - steep(T(1.0) - s, width));
}
template <class T>
T within_critical(T cosine, T alpha, T critical) {
  const T room = most(T(1.0) - critical, T(1e-6));
  const T width = alpha * sqrt(most(T(1.0) - critical * critical, T(0.0))) / room;
  return T(0.6) + T(0.4) * steep(most(cosine - critical, T(0.0)) / room, width);
}

/// How much of the view's own Fresnel factor is left out of the mean one in the
/// table of light that leaves: all for a mirror, whose mean has a kink that no
/// table holds; nothing from alpha = 0.04 on, where the mean has none.
template <class T>
T mirror_share(T alpha) {
  return most(T(1.0) - T(5.0) * sqrt(alpha), T(0.0));
}

}  // namespace table_axes

}  // namespace nacre
