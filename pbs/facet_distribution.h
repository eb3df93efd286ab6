#pragma once

namespace nacre {

/// How the normals of facets are distributed.
enum class FacetDistribution {
  ggx,       ///< Trowbridge and Reitz: long tails; pbs/microfacet.h.
  beckmann,  ///< Normally distributed slopes; pbs/beckmann.h.
};

}  // namespace nacre
