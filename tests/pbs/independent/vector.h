#pragma once

#include <cmath>

/// Lobes by the formulas of their papers, in double and one direction at a time: what the kernels
/// are compared with. Nothing here is shared with pbs/.
namespace nacre::reference {

/// In the frame of a surface: x along its tangent, z along its normal.
struct Vec {
  double x, y, z;
};

inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, Vec v) { return {s * v.x, s * v.y, s * v.z}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec unit(Vec v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

/// What a lobe does along a pair of directions.
struct Scattered {
  double f = 0.0;    ///< Times |cos(wi)|.
  double pdf = 0.0;  ///< Of wi by solid angle, given wo.
  /// Where both are the part of something that the model chooses, that: an error of the part is to
  /// be seen against it. Else 0.
  double whole_f = 0.0, whole_pdf = 0.0;
};

}  // namespace nacre::reference
