#pragma once

#include "pbs/facets.h"
#include "pbs/view.h"

namespace nacre {

/// What becomes of the light at a rough interface between dielectrics, by a sum over the facets
/// that the view sees: for what the tables of pbs/tables do not know. `eta`: index beyond over
/// that on the viewer's side. wo: above the surface, in its frame. `perfect`: the albedo of facets
/// that reflect all, of which the sum has only those that let light pass where it leaves. Without
/// `transmits` nothing of what passes is summed.
/// Light that is missing or too much where a lobe is divided by it, at worst
/// (bench/results/furnace.md, anisotropic facets): where both sides are one lobe 1.8 % in `fast`,
/// 1 % in `standard`, 0.9 % in `precise`; of transmission alone 2.5, 1.1 and 1 %.
FacetSum sum_over_facets(Recorder& recorder, Accuracy accuracy, Float3 wo, const Facets& facets,
                         Float eta, Float perfect, bool transmits);

/// facet_reflection(), and a sum over facets where tables do not do: where roughnesses differ, or
/// the index is next to 1. Of a lobe that transmits that is of both sides.
FacetReflection reflection_of_facets(Recorder& recorder, Accuracy accuracy, const Facets& facets,
                                     const LocalView& local, const FacetFresnel& fresnel,
                                     Bool inside, bool transmits);

/// What FacetSum::total has more by channel where the Fresnel factor is another than that of a
/// dielectric whose relative index is `eta`: that of those facets only which let light pass. By few
/// facets where that is a film's, which is dear.
Color3 sum_over_fresnel(Recorder& recorder, Accuracy accuracy, Float3 wo, const Facets& facets,
                        const FacetFresnel& fresnel, Float eta, Bool inside);

/// How much of the sum to take rather than of the tables: all of it for unequal roughnesses, and
/// for indices so near each other that the tables' axes cannot tell the angle of total reflection
/// from grazing; 0, and a literal where that is known, where the tables are good.
Float facet_sum_share(Float2 alpha, bool isotropic, Float dense);

}  // namespace nacre
