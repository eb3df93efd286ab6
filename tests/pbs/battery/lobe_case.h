#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "tests/support/closure.h"

namespace nacre {

/// The inputs of a lobe under test: channels of its kernels, so that one kernel
/// serves all values.
struct LobeInputs {
  Float roughness;  ///< As an artist sets it; microfacets get its square.
  Color3 color;
  Float index;  ///< Of refraction.
};

/// What a lobe promises of the light that it sends back where its colour is white.
enum class Energy {
  conserving,  ///< Not more than arrives.
  preserving,  ///< All of it.
  exceeding,   ///< More at some angles, a property of the published model.
};

/// The error of machine code that 999 of 1000 points stay below, against the same lobe in double
/// precision: of f and pdf and of a sample's weight, relative; of its direction, its length. f and
/// pdf are compared for one direction; weight for one set of random numbers, so that it also shows
/// where wi went: near the horizon a microfacet's weight falls to 0, and there the sines of `fast`
/// alone change it by 2 %.
struct RoundingBounds {
  double value, weight, direction;
};

/// A lobe in one of its forms. A row of the table is all that a new one needs.
struct LobeCase {
  std::string name;
  std::string category;  ///< Of the node.
  Ports (*ports)(const LobeInputs&);
  bool rough = true;  ///< Depends on roughness.
  Energy energy = Energy::conserving;
  double most_light = 1.0;         ///< The measured maximum; only where exceeding.
  double preserving_error = 1e-2;  ///< |1 - E| of what preserves light.
  double albedo_error = 2e-3;      ///< The albedo kernel against quadrature, capped at 1.
  /// f(o, i) over f(i, o) where both are evaluated: 1 where reciprocal, else the
  /// largest ratio over the battery's samples and roughnesses, measured; 0: promises nothing.
  double reciprocity = 1.0;
  float least_roughness = 0.05f;
  bool slow_in_double = false;  ///< By the reference: fewer points every day.
  RoundingBounds standard{1e-4, 1e-4, 1e-5};
  RoundingBounds fast{1e-3, 2e-2, 1e-3};
};

const std::vector<LobeCase>& lobe_cases();

/// Records the lobe's node.
BsdfPtr make_lobe(Recorder& recorder, const LobeCase& row, const LobeInputs& inputs,
                  Accuracy accuracy, Ports more = {});

inline void PrintTo(const LobeCase& row, std::ostream* out) { *out << row.name; }

}  // namespace nacre
