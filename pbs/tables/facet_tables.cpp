#include "pbs/tables/facet_tables.h"

namespace nacre {

namespace {

namespace ggx {
#include "pbs/tables/ggx_tables.inc"
}  // namespace ggx

namespace beckmann {
#include "pbs/tables/beckmann_tables.inc"
}  // namespace beckmann

}  // namespace

const FacetTables& facet_tables(FacetDistribution distribution) {
  static const FacetTables of_ggx{
      .reflection = {"ggx_reflection", 24, 20, 1, 3, ggx::reflection_values},
      .steep = {"ggx_steep", 24, 20, 1, 2, ggx::steep_values},
      .unequal = {"ggx_unequal", 32, 12, 12, 6, ggx::unequal_values},
      .entering = {"ggx_entering", 40, 20, 10, 2, ggx::entering_values},
      .leaving = {"ggx_leaving", 40, 16, 30, 4, ggx::leaving_values}};
  static const FacetTables of_beckmann{
      .reflection = {"beckmann_reflection", 24, 20, 1, 3, beckmann::reflection_values},
      .steep = {"beckmann_steep", 24, 20, 1, 2, beckmann::steep_values},
      .unequal = {"beckmann_unequal", 32, 12, 12, 6, beckmann::unequal_values},
      .entering = {"beckmann_entering", 40, 20, 10, 2, beckmann::entering_values},
      .leaving = {"beckmann_leaving", 40, 16, 30, 4, beckmann::leaving_values}};
  return distribution == FacetDistribution::ggx ? of_ggx : of_beckmann;
}

}  // namespace nacre
