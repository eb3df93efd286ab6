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

  /// How much more these three are where roughness along the view and across it are not equal than
  /// where both are as the former: first of slopes that are not correlated, then of such as are one
  /// and the same. On the third axis the roughness across.
  FacetTable unequal;

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
