#pragma once

#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "tests/support/tier.h"

namespace nacre {

/// An input of a composite and the values that it takes, as text; "" leaves it out.
struct CompositeAxis {
  std::string name, type;
  std::vector<std::string> values;
};

/// A shading model or a tree of closures; each configuration has one value of each axis. A row of
/// the table is all that a new one needs.
struct Composite {
  std::string name;
  std::string nodes;  ///< "{}" stands for the inputs.
  std::vector<CompositeAxis> axes;
  bool has_inside = false;     ///< Looked at from there, too.
  bool is_preserving = false;  ///< White: all light leaves.
  /// What leaves of the light that arrives, at most; more than 1.02 is the model's own
  /// (bench/results/furnace.md).
  double most_energy = 1.02;
  /// Of the albedo kernel, against the mean weight of samples: what the sum over anisotropic facets
  /// misses from inside (pbs/facet_sum.h).
  double albedo_error = 4e-2;
  /// Of `standard`, where no axis asks for a film or a sum over facets: rounding, but for what the
  /// row has of those itself.
  double standard_error = 1e-4;
};

std::span<const Composite> composites();

/// T-CHI, T-NORM, T-WGT, T-FUR and T-REC of test_lobes() on configurations of a row: in the daily
/// tier a few, in the whole one many, other ones each day. Fails the running test.
void try_composite(const Composite& row, const Tier& tier);

/// How many chi-squares those are, over all rows, where the tier is whole.
int composite_chi_squares();

inline void PrintTo(const Composite& row, std::ostream* out) { *out << row.name; }

}  // namespace nacre
