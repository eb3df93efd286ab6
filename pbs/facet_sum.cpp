#include "pbs/facet_sum.h"

#include <cmath>
#include <numbers>

#include "pbs/fresnel.h"
#include "pbs/microfacet.h"
#include "pbs/microfacet_transmission.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

/// Points of a rank-1 lattice with a Fibonacci number of them, the best there is of that kind in
/// two dimensions: Niederreiter, "Random Number Generation and Quasi-Monte Carlo Methods", 1992,
/// section 5.1. One coordinate is an azimuth, in which the sum is periodic.
struct Lattice {
  int points;
  int step;  ///< The Fibonacci number before.
};
Lattice lattice(Accuracy accuracy) {
  if (accuracy == Accuracy::fast) return {89, 55};
  return accuracy == Accuracy::standard ? Lattice{233, 144} : Lattice{610, 377};
}

struct State {
  FacetSum sum;
  Float2 azimuth;  ///< Cosine and sine.
  template <class F>
  friend void visit(State& state, F&& f) {
    nacre::visit(state.sum, f), nacre::visit(state.azimuth, f);
  }
};

}  // namespace

FacetSum lerp(const FacetSum& a, const FacetSum& b, Float t) {
  return {nacre::lerp(a.reflected, b.reflected, t), nacre::lerp(a.passed, b.passed, t),
          nacre::lerp(a.total, b.total, t), nacre::lerp(a.turned, b.turned, t)};
}

FacetSum sum_over_facets(Recorder& recorder, Accuracy accuracy, Float3 wo, const Facets& facets,
                         Float eta) {
  const Float2 alpha = facets.alpha;
  const auto [points, step] = lattice(accuracy);
  const double turn = 2.0 * std::numbers::pi * step / points;
  const Float2 on{static_cast<float>(std::cos(turn)), static_cast<float>(std::sin(turn))};
  // The facets that a view sees, as sample_visible_normal has them: where roughness is stretched
  // away they are a cap of the sphere. Azimuths begin at the view's, so that an isotropic surface
  // looks the same from all around.
  const Float x = alpha.x * wo.x, y = alpha.y * wo.y;
  const Float across2 = fma(x, x, square(y));
  const Float length = sqrt(fma(wo.z, wo.z, across2));
  const Float inverse = 1.0f / max(length, 1e-30f);
  const Float3 seen{x * inverse, y * inverse, wo.z * inverse};
  const Bool slanted = across2 > 1e-30f;
  const Float inverse_across = 1.0f / sqrt(max(across2, 1e-30f));
  const bool is_ggx = facets.distribution == FacetDistribution::ggx;
  const Float root_o = is_ggx ? length : facets.root(wo);
  const State start{.sum = {0.0f, 0.0f, 0.0f, 0.0f},
                    .azimuth = {select(slanted, x * inverse_across, 1.0f),
                                select(slanted, y * inverse_across, 0.0f)}};
  const State all = loop(recorder, Bool(true), points, start, [&](Int k, State& state) {
    const float share = 1.0f / static_cast<float>(points);
    const Float up = fma(to_float(k), -share, 1.0f - 0.5f * share);
    const auto on_cap = [&] {
      const Float z = fma(up, 1.0f + seen.z, -seen.z);
      const Float slant = safe_sqrt((1.0f - z) * (1.0f + z));
      const Float3 stretched{alpha.x * fma(slant, state.azimuth.x, seen.x),
                             alpha.y * fma(slant, state.azimuth.y, seen.y), z + seen.z};
      return stretched * Float3(1.0f / sqrt(max(dot(stretched, stretched), 1e-30f)));
    };
    const auto by_slopes = [&] {
      const Float across = fma(to_float(k), static_cast<float>(step) * share, 0.5f * share);
      return facets.sample_visible(recorder, wo, up, fract(across));
    };
    const Float3 h = is_ggx ? on_cap() : by_slopes();
    const Float cosine = saturate(dot(wo, h));
    const auto unshadowed = [&](Float3 wi, Bool possible) {
      const Float cos_i = abs(wi.z);
      return select(possible, smith_shadowing(wo.z, root_o, cos_i, facets.root(wi)), 0.0f);
    };
    const Float3 mirrored = reflect(wo, h);
    const Refraction bent = refract(wo, h, cosine, eta);
    const Float back = unshadowed(mirrored, mirrored.z > 0.0f);
    const Float forth = unshadowed(bent.wi, bent.possible);
    const Float fresnel = fresnel_dielectric(cosine, eta);
    state.sum.reflected = fma(back, share, state.sum.reflected);
    state.sum.passed = fma(forth, share, state.sum.passed);
    state.sum.total = fma(lerp(forth, back, fresnel), share, state.sum.total);
    const Bool turns = totally_reflected(cosine, eta);
    state.sum.turned = fma(select(turns, back, 0.0f), share, state.sum.turned);
    const Float2 now = state.azimuth;
    state.azimuth = {fma(now.x, on.x, -(now.y * on.y)), fma(now.x, on.y, now.y * on.x)};
    return Bool(true);
  });
  return {saturate(all.sum.reflected), saturate(all.sum.passed), saturate(all.sum.total),
          saturate(all.sum.turned)};
}

Float facet_sum_share(Float2 alpha, bool isotropic, Float dense) {
  // All of it from ratios of 0.95 and indices of 1.05 on, none from 1 and 1.1.
  const Float near = saturate(fma(dense, -20.0f, 22.0f));
  if (isotropic) return near;
  const Float wide = max(alpha.x, alpha.y), narrow = min(alpha.x, alpha.y);
  return max(near, saturate(20.0f * (wide - narrow) / wide));
}

}  // namespace nacre
