#pragma once

#include <cstdint>
#include <vector>

#include "runtime/program/program.h"

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

/// The outputs of a Program at one point, by output channel; of an integer or a truth
/// value the bits as a number. By interval arithmetic
/// (Moore, Kearfott and Cloud, "Introduction to Interval Analysis", 2009) on the Program
/// that the reference engine runs. Every operation widens by half an ulp of a float, a
/// transcendental function by the 4 ulp that `standard` promises; contraction to fma,
/// which only leaves roundings out, stays inside. Where a comparison can fall either way
/// both results count, and a loop that may end now or later leaves every number open.
std::vector<Enclosure> enclose(const Program& program, const std::vector<std::uint32_t>& inputs,
                               const std::vector<std::uint32_t>& parameters, FloatRange range = {});

}  // namespace nacre::testing
