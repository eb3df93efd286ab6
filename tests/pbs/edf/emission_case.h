#pragma once

#include <ostream>
#include <span>
#include <string>

namespace nacre {

/// A document's EDF "e", or surface "s", and what it emits.
struct EmissionCase {
  std::string name;
  std::string nodes;         ///< Elements of a document.
  std::string profile = {};  ///< Of the file light.ies, if there is one.
  /// Power of red for an area of 1: radiance cos over both sides, where the shading normal is that
  /// of the surface. From a closed form or an integral of the model's text, by hand.
  double power = 0.0;
  /// No sample may weigh more, at any normals.
  double most_weight = 0.0;
  /// Of samples without light, by digits of narrow shapes; 0: none is.
  double lost = 0.0;
  /// Deviation of a sample's weight from the mean, over that, at most; there, too. 0: not tried.
  double spread = 0.0;
};

std::span<const EmissionCase> emission_cases();

inline void PrintTo(const EmissionCase& row, std::ostream* out) { *out << row.name; }

}  // namespace nacre
