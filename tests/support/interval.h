#pragma once

#include "runtime/program/op.h"

namespace nacre::testing {

/// What a value may be in any engine that keeps to op.h: every number from lo to hi
/// (none where lo > hi), and NaN. A number that leaves the floats is both itself, as in
/// double, and infinite or zero, as in float.
struct Enclosure {
  double lo = 0.0;
  double hi = 0.0;
  bool nan = false;

  bool is_exact() const { return lo == hi && !nan; }
  bool contains(double x) const;
  /// One number, NaN alone, or numbers that differ by 1e-3 of the least of them at most.
  bool is_narrow() const;
};

/// Where floats end and doubles don't. A test that leaves one out learns whether a result
/// needs it.
struct FloatRange {
  bool overflows = true;   ///< Numbers above the largest float may be infinite.
  bool underflows = true;  ///< Numbers below the smallest normal float may be zero.
};

bool has_numbers(const Enclosure& x);
/// Of one number: NaN or that.
Enclosure exactly(double x);
Enclosure unite(const Enclosure& a, const Enclosure& b);

/// The result of an operation on exact operands: one number where it is a float.
Enclosure rounded_once(double x, FloatRange range);
/// What an operation f32 -> f32 gives; operands that it lacks are {0, 0}.
Enclosure compute(Op op, const Enclosure& a, const Enclosure& b, const Enclosure& c,
                  FloatRange range);

}  // namespace nacre::testing
