#include "tests/pbs/battery/oracle_case.h"

#include <cmath>
#include <numbers>

#include "tests/pbs/battery/oracle_rows.h"

namespace nacre {

using reference::Vec;

Vec from_normal(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Vec draw_view(Random& random, bool inside_too) {
  constexpr double degree = std::numbers::pi / 180.0;
  static const std::vector<double> angles{0.0,         1e-4,          20 * degree,   45 * degree,
                                          60 * degree, 80 * degree,   85 * degree,   88 * degree,
                                          89 * degree, 89.9 * degree, 89.99 * degree};
  Vec wo = from_normal(random.pick(angles), 2.0 * std::numbers::pi * uniform(random));
  if (inside_too && random.chance(0.5)) wo.z = -wo.z;
  return wo;
}

Vec draw_above(Random& random) {
  const double z = random.chance(0.25) ? std::pow(10.0, -4.0 * uniform(random)) : uniform(random);
  return from_normal(std::acos(z), 2.0 * std::numbers::pi * uniform(random));
}

const std::vector<OracleCase>& oracle_cases() {
  static const std::vector<OracleCase> cases = [] {
    std::vector<OracleCase> all = broad_cases();
    for (OracleCase& row : facet_cases()) all.push_back(std::move(row));
    for (OracleCase& row : film_cases()) all.push_back(std::move(row));
    return all;
  }();
  return cases;
}

}  // namespace nacre
