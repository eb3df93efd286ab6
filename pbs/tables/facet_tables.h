#pragma once

#include <span>
#include <string_view>

#include "pbs/facet_distribution.h"

namespace nacre {

/// Hemispherical integrals of the lobes of facets, isotropic, for one view: nodes on the axes of
/// pbs/tables/axes.h, angle fastest, then roughness, then index; the quantities of one node side by
/// side. Written by make_tables.cpp; tests/pbs/energy_test.cpp recomputes entries another way.
struct FacetTable {
  std::string_view name;  ///< Of the table in a Program.
  int angles, roughnesses, indices;
  int quantities;
  std::span<const float> values;
};

/// Of one distribution of facets.
struct FacetTables {
  /// For perfectly reflecting facets: the albedo E, and the facet cosines that
  /// stand for the darker and the brighter half of the reflected light, each less
  /// the cosine of the view. The mean over a half of (1 - cosine)^5.4 is exact.
  FacetTable reflection;

  /// Those two cosines for (1 - cosine)^10: what Fresnel's factor of an index next to 1 is like.
  FacetTable steep;

  /// How much more the albedo E is where roughness is not equal on both axes than with the wider
  /// one alone: of a view along that axis, and of one across it that is as much masked. Angle: of
  /// the former, with the wider roughness; on the third axis the root of the ratio of the narrower
  /// roughness to it.
  FacetTable stretched;

  /// Relative index above 1. The albedo of transmission without a Fresnel factor,
  /// and of reflection and transmission together with it.
  FacetTable entering;

  /// Relative index below 1. The mean Fresnel factor of what is reflected, less
  /// mirror_share of that of the view; the albedo of transmission
  /// without a Fresnel factor; that of both with it, divided by E; and the part of E of facets
  /// that reflect all light.
  FacetTable leaving;
};
const FacetTables& facet_tables(FacetDistribution distribution);

}  // namespace nacre
