#pragma once

#include <utility>

#include "tests/pbs/battery/oracle_case.h"

namespace nacre {

/// The rows of oracle_cases(), by what they are of: lobes that spread widely and fibres, facets,
/// and facets under films or of walls without an inside.
/// @{
std::vector<OracleCase> broad_cases();
std::vector<OracleCase> facet_cases();
std::vector<OracleCase> film_cases();
/// @}

/// By angles to the normal and about it, in radians.
reference::Vec from_normal(double theta, double phi);
/// At the normal, next to it, and as far as grazing.
reference::Vec draw_view(Random& random, bool inside_too);
/// Uniform, and one of four at grazing.
reference::Vec draw_above(Random& random);

inline Ports with(Ports ports, const char* name, Recorded value) {
  ports[name] = std::move(value);
  return ports;
}

}  // namespace nacre
