#include "pbs/facet_sum.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "pbs/fresnel.h"
#include "pbs/microfacet.h"
#include "pbs/microfacet_transmission.h"
#include "pbs/sampling.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

/// Facets of a sum: points of a rank-1 lattice with a Fibonacci number of them, the best there is
/// of that kind in two dimensions: Niederreiter, "Random Number Generation and Quasi-Monte Carlo
/// Methods", 1992, section 5.1. One coordinate is an azimuth, in which the sum is periodic. Where
/// light is totally reflected from some angle on, and views see hardly any that passes, it takes
/// many more than where light enters, for the same error.
struct Points {
  int entering, leaving;
};

/// Beckmann's facets are found by Newton's steps, each many times as dear as one of GGX's.
Points points_of(Accuracy accuracy, FacetDistribution distribution) {
  const bool is_dear = distribution == FacetDistribution::beckmann;
  if (accuracy == Accuracy::fast) return {34, is_dear ? 89 : 144};
  if (accuracy == Accuracy::standard) return {89, is_dear ? 144 : 987};
  return is_dear ? Points{144, 377} : Points{377, 2584};
}

/// Fewer do for a mean over the reflected light.
Points points_of_mean(Accuracy accuracy, FacetDistribution distribution) {
  const bool is_dear = distribution == FacetDistribution::beckmann;
  if (accuracy == Accuracy::fast) return {21, is_dear ? 34 : 89};
  if (accuracy == Accuracy::standard) return {34, is_dear ? 89 : 377};
  return is_dear ? Points{89, 144} : Points{144, 987};
}

/// Fewer still where each facet's Fresnel factor is dear, as under a film.
Points points_of_film(Accuracy accuracy) {
  if (accuracy == Accuracy::fast) return {21, 34};
  return {accuracy == Accuracy::standard ? 34 : 89, 144};
}

/// In between, of a curve over both sides of an interface.
Points points_of_curve(Accuracy accuracy, FacetDistribution distribution) {
  return {points_of(accuracy, distribution).entering,
          points_of_mean(accuracy, distribution).leaving};
}

/// The Fibonacci number before: what a lattice of so many points steps by.
int fibonacci_before(int points) {
  int before = 1, at = 1;
  while (at < points) before = std::exchange(at, at + before);
  return before;
}

/// That of each lane.
struct LaneLattice {
  int most;  ///< Points of any lane.
  Int points;
  Float share;   ///< One over their number.
  Float across;  ///< From a point to the next, of the unit square's second side.
  Float2 turn;   ///< The same around the view: cosine and sine.
};
LaneLattice in_lanes(Points points, Bool leaving) {
  const auto either = [&](auto&& number) {
    return select(leaving, Float(static_cast<float>(number(points.leaving))),
                  Float(static_cast<float>(number(points.entering))));
  };
  const auto across = [](int n) { return static_cast<double>(fibonacci_before(n)) / n; };
  const auto turn = [&](int n) { return 2.0 * std::numbers::pi * across(n); };
  return {.most = std::max(points.entering, points.leaving),
          .points = select(leaving, Int(points.leaving), Int(points.entering)),
          .share = either([](int n) { return 1.0 / n; }),
          .across = either(across),
          .turn = {either([&](int n) { return std::cos(turn(n)); }),
                   either([&](int n) { return std::sin(turn(n)); })}};
}

template <class Sum>
struct State {
  Sum sum;
  Float2 azimuth;  ///< Cosine and sine.
  template <class F>
  friend void visit(State& state, F&& f) {
    visit(state.sum, f), visit(state.azimuth, f);
  }
};

/// A facet that the view sees, and what is seen of what it reflects: 0 below the surface.
struct Facet {
  Float3 h;
  Float cosine;  ///< To the view, in [0, 1].
  Float back;
  Float change;  ///< Of cosine^2 from a facet of the lattice to the next; 0 where nobody knows.
};

/// How much cosine^2, that of the view wo to the normal v of any length, changes where v does so by
/// `d`.
Float change_of_cosine2(Float3 wo, Float3 v, Float3 d) {
  const Float inverse = 1.0f / max(dot(v, v), 1e-30f);
  const Float along = dot(wo, v);
  return 2.0f * inverse * along * fma(-along * inverse, dot(v, d), dot(wo, d));
}

/// add(facet, unshadowed, share, sum) for each, `share` being one over their number;
/// unshadowed(wi, possible): what is seen of light along wi.
template <class Sum, class F>
Sum over_facets(Recorder& recorder, const LaneLattice& lattice, Float3 wo, const Facets& facets,
                Sum start_sum, F&& add) {
  const Float2 alpha = facets.alpha;
  const Float share = lattice.share;
  const Float2 on = lattice.turn;
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
  const State<Sum> start{.sum = start_sum,
                         .azimuth = {select(slanted, x * inverse_across, 1.0f),
                                     select(slanted, y * inverse_across, 0.0f)}};
  const auto next = [&](Int k, State<Sum>& state) {
    const Float up = fma(to_float(k), -share, 1.0f - 0.5f * share);
    Float change = 0.0f;
    const auto on_cap = [&] {
      const Float z = fma(up, 1.0f + seen.z, -seen.z);
      const Float slant = safe_sqrt((1.0f - z) * (1.0f + z));
      const Float3 stretched{alpha.x * fma(slant, state.azimuth.x, seen.x),
                             alpha.y * fma(slant, state.azimuth.y, seen.y), z + seen.z};
      const Float outwards = -z / max(slant, 1e-6f);
      const Float3 upwards{alpha.x * state.azimuth.x * outwards,
                           alpha.y * state.azimuth.y * outwards, 1.0f};
      const Float3 around{-alpha.x * slant * state.azimuth.y, alpha.y * slant * state.azimuth.x,
                          0.0f};
      const Float by_height = (1.0f + seen.z) * change_of_cosine2(wo, stretched, upwards);
      const Float by_azimuth = 2.0f * pi * change_of_cosine2(wo, stretched, around);
      change = sqrt(fma(by_height, by_height, square(by_azimuth)) * share);
      return stretched * Float3(1.0f / sqrt(max(dot(stretched, stretched), 1e-30f)));
    };
    const auto by_slopes = [&] {
      const Float across = fma(to_float(k), lattice.across, 0.5f * share);
      return facets.sample_visible(wo, up, fract(across));
    };
    const Float3 h = is_ggx ? on_cap() : by_slopes();
    const Float cosine = saturate(dot(wo, h));
    const auto unshadowed = [&](Float3 wi, Bool possible) {
      const Float cos_i = abs(wi.z);
      return select(possible, smith_shadowing(wo.z, root_o, cos_i, facets.root(wi)), 0.0f);
    };
    const Float3 mirrored = reflect(wo, h);
    const Float back = unshadowed(mirrored, mirrored.z > 0.0f);
    add(Facet{h, cosine, back, change}, unshadowed, share, state.sum);
    const Float2 now = state.azimuth;
    state.azimuth = {fma(now.x, on.x, -(now.y * on.y)), fma(now.x, on.y, now.y * on.x)};
    return k + Int(1) < lattice.points;
  };
  return loop(recorder, Bool(true), lattice.most, start, next).sum;
}

/// Of the lattice's cell that a facet stands for, where eta < 1: light passes up to the angle of
/// total reflection, where it does not fade. Measured: seven tenths of what cosine^2 changes by
/// from cell to cell are the best width; of that, what lies in [0, 1]. Without this the steep
/// facets of a grazing cell count as if some let nothing pass, at indices where nearly all do.
Float part_that_passes(const Facet& facet, Float eta) {
  const Float cosine2 = square(facet.cosine);
  const Float within = fma(facet.cosine, facet.cosine, (eta - 1.0f) * (eta + 1.0f));
  const Float inverse = 1.0f / clamp(0.7f * facet.change, 1e-12f, 2.0f);
  const Float below = max(0.5f - cosine2 * inverse, 0.0f);
  const Float above = max(fma(cosine2 - 1.0f, inverse, 0.5f), 0.0f);
  return saturate((fma(within, inverse, 0.5f) - above) / (1.0f - below - above));
}

/// Of y = (1 - cosine)^4: what Fresnel factors rise by at grazing, and needs no root.
struct Moments {
  Float light, first, second, third;
  template <class F>
  friend void visit(Moments& m, F&& f) {
    f(m.light), f(m.first), f(m.second), f(m.third);
  }
};

struct RestSum {
  Float light;
  Color3 rest;
  template <class F>
  friend void visit(RestSum& sum, F&& f) {
    f(sum.light), nacre::visit(sum.rest, f);
  }
};

/// Null where there is no film.
FacetFresnelPtr in_sums(const FacetFresnel& fresnel) {
  const ThinFilm* const film = fresnel.film();
  return film == nullptr || !film->exists() ? nullptr : fresnel.with_film(film->in_sums());
}

Float cosine_of(Float y) { return 1.0f - sqrt(sqrt(saturate(y))); }

}  // namespace

FacetSum lerp(const FacetSum& a, const FacetSum& b, Float t) {
  return {nacre::lerp(a.reflected, b.reflected, t), nacre::lerp(a.passed, b.passed, t),
          nacre::lerp(a.total, b.total, t), nacre::lerp(a.turned, b.turned, t)};
}

FacetSum sum_over_facets(Recorder& recorder, Accuracy accuracy, Float3 wo, const Facets& facets,
                         Float eta, LobeOfFacets lobe) {
  // Of equal roughnesses the sum is for indices next to 1 alone, which lets the lobe end soon after
  // the angle of total reflection, on either side.
  const Bool many =
      facets.isotropic ? Bool(true) : (eta < 1.0f) | (facet_stretch(facets.alpha) <= 0.0f);
  const FacetSum all =
      over_facets(recorder, in_lanes(points_of(accuracy, facets.distribution), many), wo, facets,
                  FacetSum{0.0f, 0.0f, 0.0f, 0.0f},
                  [&](const Facet& facet, const auto& unshadowed, Float share, FacetSum& sum) {
                    const Refraction bent = refract(wo, facet.h, facet.cosine, eta);
                    const Float back = facet.back;
                    const Float fresnel = fresnel_dielectric(facet.cosine, eta);
                    sum.reflected = fma(back, share, sum.reflected);
                    if (lobe == LobeOfFacets::joint) {
                      const Float forth = unshadowed(bent.wi, bent.possible);
                      sum.passed = fma(forth, share, sum.passed);
                      sum.total = fma(lerp(forth, back, fresnel), share, sum.total);
                      return;
                    }
                    const Float part = select(eta < 1.0f, part_that_passes(facet, eta), 1.0f);
                    const Float forth = unshadowed(bent.wi, bent.wi.z < 0.0f);
                    sum.passed = fma(forth * part, share, sum.passed);
                    sum.total = fma(lerp(forth, back, fresnel), share, sum.total);
                    sum.turned = fma(back * (1.0f - part), share, sum.turned);
                  });
  return {saturate(all.reflected), saturate(all.passed), saturate(all.total), saturate(all.turned)};
}

FacetReflection reflection_of_facets(Recorder& recorder, Accuracy accuracy, const Facets& facets,
                                     const LocalView& local, const FacetFresnel& fresnel,
                                     Bool inside) {
  const FacetView seen = facets.table_view(local);
  FacetReflection table = facet_reflection(recorder, seen);
  Float steep = 0.0f;
  if (fresnel.covers_dielectric()) {
    const Float index = fresnel.index();
    steep = steepness(max(index, 1.0f / index), 1.0f - fresnel.film_share());
    table = for_dielectric(recorder, seen, table, steep);
  }
  const Points few = points_of_mean(accuracy, facets.distribution);
  const Float eta = relative_index(fresnel.index(), inside);
  const auto mean_dielectric = [&](Bool leaving) {
    const Float2 light = over_facets(
        recorder, in_lanes(few, leaving), local.wo, facets, Float2{0.0f, 0.0f},
        [&](const Facet& facet, const auto&, Float, Float2& all) {
          all = {all.x + facet.back, fma(facet.back, fresnel_dielectric(facet.cosine, eta), all.y)};
        });
    return light.y / max(light.x, 1e-20f);
  };
  if (fresnel.has_inside() && !fresnel.is_dielectric()) {
    // What goes up and down with the cosine, or bends up steeply, and then is total reflection has
    // no two cosines. What it is more than a dielectric's curve has no step, and a small sum.
    const Float share = fresnel.covers_dielectric() ? fresnel.film_share() : Float(1.0f);
    const FacetFresnelPtr filmed = in_sums(fresnel);
    const FacetFresnel& of_facets = filmed == nullptr ? fresnel : *filmed;
    table.rest_share = select((eta < 1.0f) & !facets.delta, share, 0.0f);
    table.rest = if_any(table.rest_share > 0.0f, Color3(0.0f), [&] {
      const RestSum sum = over_facets(
          recorder, in_lanes(points_of_film(accuracy), Bool(true)), local.wo, facets,
          RestSum{0.0f, Color3(0.0f)}, [&](const Facet& facet, const auto&, Float, RestSum& all) {
            const Float bare = fresnel_dielectric(facet.cosine, eta);
            const Color3 rest = of_facets.at(facet.cosine, inside) - Color3(bare);
            all.light = all.light + facet.back;
            all.rest = fma(rest, Color3(facet.back), all.rest);
          });
      return sum.rest * Color3(1.0f / max(sum.light, 1e-20f));
    });
  }
  const Bool leaving = fresnel.has_inside() ? eta < 1.0f : Bool(false);
  const Float stretch = seen.stretch;
  if (fresnel.has_inside()) {
    // Next to 1 no cosines stand for Fresnel's curve, nor can a table's axes tell where total
    // reflection begins. Measured, of equal roughnesses: the sum is better up to indices of 1.01
    // where light enters, of 1.025 where it leaves; not from 1.06 and 1.05 on. Of unequal ones it
    // is of light that leaves, whatever the index: where total reflection sets in no two cosines
    // stand for all.
    const Float dense = max(fresnel.index(), 1.0f / fresnel.index());
    const Float where_leaving = facet_sum_share(facets.alpha, true, fma(2.0f, dense, -1.0f));
    const Float where_entering = fresnel.covers_dielectric()
                                     ? facet_sum_share(facets.alpha, true, dense + 0.04f)
                                     : Float(0.0f);
    // Nothing is recorded for an index that is known to be another.
    const bool never = where_leaving.is_constant(0.0f) && where_entering.is_constant(0.0f);
    if (!facets.isotropic || !never) {
      table.summed =
          select(leaving, max(stretch, where_leaving), (1.0f - stretch) * where_entering);
      table.dielectric = if_any((table.summed > 0.0f) & !facets.delta, Float(0.0f),
                                [&] { return mean_dielectric(never ? Bool(true) : leaving); });
    }
  }
  // The table's two cosines will do but for curves that are steep at grazing.
  const Float share = select(steep > 0.0f, stretch, 0.0f);
  return if_any((share > 0.0f) & !facets.delta, table, [&] {
    const Moments sum = over_facets(
        recorder, in_lanes(few, Bool(false)), local.wo, facets, Moments{0.0f, 0.0f, 0.0f, 0.0f},
        [](const Facet& facet, const auto&, Float, Moments& m) {
          const Float y = square(square(1.0f - facet.cosine));
          const Float first = facet.back * y, second = first * y;
          m = {m.light + facet.back, m.first + first, m.second + second, fma(second, y, m.third)};
        });
    const Float inverse = 1.0f / max(sum.light, 1e-20f);
    const Float mean = sum.first * inverse;
    const Float variance = max(fma(sum.second, inverse, -square(mean)), 0.0f);
    const Float cubed =
        fma(mean, fma(-3.0f * sum.second, inverse, 2.0f * square(mean)), sum.third * inverse);
    // The nodes are the roots of x^2 - skew x - variance about the mean: polynomials of y up to the
    // third degree have their mean (Golub and Welsch, "Calculation of Gauss Quadrature Rules",
    // 1969, for two nodes). The root with the digits first, the other by their product.
    const Float skew = cubed / max(variance, 1e-12f);
    const Float far = 0.5f * (skew + copysign(sqrt(fma(skew, skew, 4.0f * variance)), skew));
    const Float near = select(abs(far) > 1e-12f, -variance / far, 0.0f);
    const Float far_share = variance / max(fma(far, far, variance), 1e-24f);
    // In the order that the table's are in: what lies between one and another is neither else.
    const Bool far_is_low = far > near;
    FacetReflection result = table;
    result.low = lerp(table.low, cosine_of(mean + max(far, near)), share);
    result.high = lerp(table.high, cosine_of(mean + min(far, near)), share);
    result.low_share = lerp(0.5f, select(far_is_low, far_share, 1.0f - far_share), share);
    return result;
  });
}

Color3 sum_over_fresnel(Recorder& recorder, Accuracy accuracy, Float3 wo, const Facets& facets,
                        const FacetFresnel& fresnel, Float eta, Bool inside) {
  const FacetFresnelPtr filmed = in_sums(fresnel);
  const FacetFresnel& of_facets = filmed == nullptr ? fresnel : *filmed;
  // Not by whether there is a film, which nobody knows of one that may come.
  const Points points = fresnel.covers_dielectric()
                            ? points_of_film(accuracy)
                            : points_of_curve(accuracy, facets.distribution);
  return over_facets(recorder, in_lanes(points, eta < 1.0f), wo, facets, Color3(0.0f),
                     [&](const Facet& facet, const auto& unshadowed, Float share, Color3& sum) {
                       const Refraction bent = refract(wo, facet.h, facet.cosine, eta);
                       const Float forth = unshadowed(bent.wi, bent.possible);
                       const Color3 more = of_facets.at(facet.cosine, inside) -
                                           Color3(fresnel_dielectric(facet.cosine, eta));
                       sum = fma(more, Color3((facet.back - forth) * share), sum);
                     });
}

Float facet_sum_share(Float2 alpha, bool isotropic, Float dense) {
  // All of it from ratios of 0.95 and indices of 1.05 on, none from 1 and 1.1.
  const Float near = saturate(fma(dense, -20.0f, 22.0f));
  return isotropic ? near : max(near, facet_stretch(alpha));
}

}  // namespace nacre
