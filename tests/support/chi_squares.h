#pragma once

#include <nacre/lobe_test/chi_square.hpp>

namespace nacre {

/// Chi-squares of closures that one night makes at most, by what makes them; each asserts that it
/// makes no more.
namespace chi_squares_of {
constexpr int lobes = 2'500, narrow_lobes = 3'000, composites = 4'000, phases = 100;
constexpr int all = lobes + narrow_lobes + composites + phases;
}  // namespace chi_squares_of

/// What the probability of each must exceed, so that one of them fails by chance in one night of a
/// thousand (Sidak 1967).
inline double chi_square_level() { return level_of_one(chi_squares_of::all); }

}  // namespace nacre
