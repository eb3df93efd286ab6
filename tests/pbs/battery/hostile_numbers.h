#pragma once

#include <cstdint>
#include <vector>

#include "tests/pbs/battery/closure_case.h"
#include "tests/support/random.h"

namespace nacre {

/// How far the numbers of one point are from what a scene has.
enum class Hostility : std::uint8_t {
  plausible,  ///< Within what they mean, mostly at its edges.
  mixed,      ///< The same, but each with a chance of 1 in 8 is any float.
  wild,       ///< Any floats: half of them those that break arithmetic, and any bits.
};

/// Of each of so many points: half of them plausible, a quarter wild.
std::vector<Hostility> hostilities(Random& random, std::size_t count);

/// A float for an input of this meaning.
float hostile_number(Random& random, Meaning meaning, Hostility hostility);

/// Three floats: a unit vector unless hostile, as far from its axis as 89.99 degrees or beyond the
/// horizon. `axis`: 0 or 2, x or z; `along`: the chance that it is the axis itself.
void hostile_direction(Random& random, Hostility hostility, int axis, double along, float out[3]);

/// A random number in [0, 1), the ends among them.
float hostile_unit(Random& random);

}  // namespace nacre
