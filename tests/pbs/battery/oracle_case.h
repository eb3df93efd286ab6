#pragma once

#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "tests/pbs/independent/vector.h"
#include "tests/support/closure.h"
#include "tests/support/random.h"

namespace nacre {

/// What a lobe is told; T is Float where it is recorded, double for who knows its formula. Each is
/// a channel, so that one kernel serves all values.
template <class T>
struct OracleInputs {
  T color{0.5f}, color82{1.0f}, color90{1.0f};  ///< Grey.
  T roughness{0.3f};
  T alpha_x{0.3f}, alpha_y{0.3f};
  T index{1.5f}, extinction{0.0f};
  T film_thickness{0.0f}, film_index{1.5f};  ///< nm.
  T exponent{5.0f};
  T variance{0.1f}, scale{0.2f}, cuticle_angle{0.5f}, absorption{0.0f};  ///< Hair.
};
/// Calls f(name, value) for each.
template <class Inputs, class F>
void visit_inputs(Inputs& in, F&& f) {
  f("color", in.color), f("color82", in.color82), f("color90", in.color90);
  f("roughness", in.roughness), f("alpha_x", in.alpha_x), f("alpha_y", in.alpha_y);
  f("index", in.index), f("extinction", in.extinction), f("exponent", in.exponent);
  f("film_thickness", in.film_thickness), f("film_index", in.film_index);
  f("variance", in.variance), f("scale", in.scale), f("cuticle_angle", in.cuticle_angle);
  f("absorption", in.absorption);
}
using Values = OracleInputs<double>;

/// A lobe by its formula, seen from one side above.
struct SeenLobe {
  std::function<reference::Scattered(reference::Vec wi)> at;
  /// Of the light, what leaves again; nothing is compared where it is NaN.
  double albedo = std::numeric_limits<double>::quiet_NaN();
};

/// What is asked of one lobe: a view of it, and directions of light.
struct OracleView {
  Values inputs;
  reference::Vec wo;  ///< Below the surface too, where the lobe has an inside.
  std::vector<reference::Vec> wi;
};

/// What 999 of 1000 points keep to, beside what no algebra gives back: 20 roundings by the width of
/// the lobe. Relative, of no less than a millionth of the largest value that the view has.
struct OracleGate {
  double f = 0.0, pdf = 0.0;
};

/// A closure in one of its forms; a row of the table in bench/results/lobes.md.
struct OracleCase {
  std::string name;
  std::string category;
  Ports (*ports)(const OracleInputs<Float>&);
  /// Of a view from above; `inside`: turned over from below.
  SeenLobe (*seen)(const Values&, reference::Vec wo, bool inside);
  /// Fills in what the row varies.
  void (*draw)(Random&, OracleView&);
  /// A direction where the lobe is bright. In the frame of `wo`, which is above.
  reference::Vec (*toward)(Random&, const Values&, reference::Vec wo, bool inside);
  /// By which a rounding of the directions counts: as the angle over which f changes, at most 1.
  double (*width)(const Values&, reference::Vec wo, reference::Vec wi, bool inside);
  OracleGate standard{1e-4, 1e-4}, fast{1e-3, 1e-3};
  double albedo = 1e-4;      ///< Error of the albedo kernel at standard, of the light.
  bool is_fast_too = true;   ///< Else what is narrower than `fast` knows: mirrors there.
  bool thin_walled = false;  ///< Of the surface: there is no inside.
};

const std::vector<OracleCase>& oracle_cases();

/// In [0, 1).
inline double uniform(Random& random) { return static_cast<double>(random.word() >> 11) * 0x1p-53; }

inline void PrintTo(const OracleCase& row, std::ostream* out) { *out << row.name; }

}  // namespace nacre
