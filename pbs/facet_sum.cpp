#include "pbs/facet_sum.h"

#include <fmt/format.h>

#include <string>

#include "pbs/estimate.h"
#include "pbs/fresnel.h"
#include "pbs/visible_facets.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

/// What passes ends more steeply than what is reflected, which Fresnel's factor lets fade.
VisibleFacets::Lines lines_of(Accuracy accuracy, bool transmits) {
  if (accuracy == Accuracy::fast) return {13, transmits ? 34 : 21};
  if (accuracy == Accuracy::standard) return {21, transmits ? 55 : 34};
  return {34, transmits ? 89 : 55};
}

/// Where each facet's Fresnel factor is dear, as under a film.
VisibleFacets::Lines lines_of_film(Accuracy accuracy) {
  if (accuracy == Accuracy::fast) return {13, 13};
  return accuracy == Accuracy::standard ? VisibleFacets::Lines{13, 21}
                                        : VisibleFacets::Lines{34, 34};
}

/// What facets of a dielectric do with light.
class Interface {
 public:
  Interface(const Facets& facets, Float3 wo, Float eta)
      : facets_(facets),
        wo_(wo),
        root_(facets.root(wo)),
        above_(wo.z + root_),
        eta2_(square(eta)),
        beyond_((eta - 1.0f) * (eta + 1.0f)) {}

  struct Light {
    Float back, forth;  ///< Of the facet's share, by above(): 0 on the other side of the surface.
                        ///< The latter also where nobody asks whether it `transmits`.
    Float fresnel;      ///< 0 to the bit where the index is 1.
  };
  /// What smith_shadowing() has of the view alone.
  Float above() const { return above_; }
  Light at(const VisibleFacet& facet, bool transmits) const {
    const Float cosine = facet.cosine;
    // Times eta, the cosine beyond; 0 where light is totally reflected.
    const Float cosine2 = square(cosine);
    const Float beyond = estimated_root(max(cosine2 + beyond_, 0.0f));
    // (c - g) / (c + g) and (eta^2 c - g) / (eta^2 c + g), their differences divided out.
    const Float s = cosine + beyond, p = fma(eta2_, cosine, beyond);
    const Float inverse = estimated_inverse(max(s * p, 1e-18f));
    const Float of_s = p * inverse, of_p = s * inverse;
    const Float across = beyond_ * square(of_s);
    const Float along = beyond_ * square(of_p) * fma(cosine2, eta2_ + 1.0f, -1.0f);
    // Refracted, times eta: what is seen of it is the same of any length.
    const Sent back = sent(facet, cosine + cosine, 1.0f);
    const Sent forth = transmits ? sent(facet, -(beyond_ * of_s), -1.0f) : Sent{0.0f, 1.0f};
    // smith_shadowing() of both by one division.
    const Float either = facet.share * estimated_inverse(max(back.dark * forth.dark, 1e-24f));
    return {.back = back.cosine * forth.dark * either,
            .forth = forth.cosine * back.dark * either,
            .fresnel = min(0.5f * fma(across, across, square(along)), 1.0f)};
  }

 private:
  struct Sent {
    Float cosine;  ///< To the normal on the side `side` of the surface, else 0.
    Float dark;    ///< What smith_shadowing() divides by.
  };
  /// Along the facet's normal times `along`, less the view.
  Sent sent(const VisibleFacet& facet, Float along, float side) const {
    const Float3 wi = fma(Float3(along * facet.inverse), facet.normal, -wo_);
    const Float cosine = max(side * wi.z, 0.0f);
    const Float x = facets_.alpha.x * wi.x, y = facets_.alpha.y * wi.y;
    const bool is_ggx = facets_.distribution == FacetDistribution::ggx;
    const Float root =
        is_ggx ? estimated_root(fma(x, x, fma(y, y, square(wi.z)))) : facets_.root(wi);
    return {cosine, fma(cosine, root_, wo_.z * root)};
  }

  const Facets& facets_;
  Float3 wo_;
  Float root_, above_, eta2_, beyond_;
};

/// What facets send on, and with Fresnel's factor.
struct Sums {
  Float share = 0.0f;
  Float back = 0.0f, back_fresnel = 0.0f;    ///< Above the surface, and times F.
  Float forth = 0.0f, forth_fresnel = 0.0f;  ///< Below it.
  template <class F>
  friend void visit(Sums& sums, F&& f) {
    f(sums.share), f(sums.back), f(sums.back_fresnel), f(sums.forth), f(sums.forth_fresnel);
  }
};

/// Null where there is no film.
FacetFresnelPtr in_sums(const FacetFresnel& fresnel) {
  const ThinFilm* const film = fresnel.film();
  return film == nullptr || !film->exists() ? nullptr : fresnel.with_film(film->in_sums());
}

/// What a curve is more than a dielectric's, over what facets send back and, less that, over what
/// they let pass if it `transmits`. Of facets that reflect all light it is nothing.
Color3 sum_of_rest(Recorder& recorder, VisibleFacets::Lines lines, Bool many, Float3 wo,
                   const Facets& facets, const FacetFresnel& fresnel, Float eta, Bool inside,
                   bool transmits) {
  const FacetFresnelPtr filmed = in_sums(fresnel);
  const FacetFresnel& of_facets = filmed == nullptr ? fresnel : *filmed;
  const Interface interface(facets, wo, eta);
  const Color3 all =
      VisibleFacets(wo, facets, eta)
          .sum(recorder, lines, many, Color3(0.0f), [&](const VisibleFacet& facet, Color3& sum) {
            const Interface::Light light = interface.at(facet, transmits);
            const Color3 more = of_facets.at(facet.cosine, inside) - Color3(light.fresnel);
            sum = fma(more, Color3(light.back - light.forth), sum);
          });
  return all * Color3(interface.above());
}

FacetSum record_sum(Recorder& recorder, Accuracy accuracy, Float3 wo, const Facets& facets,
                    Float eta, Float perfect, bool transmits) {
  // Where light leaves, the sum is of the facets that let it pass. Of those next to index 1, which
  // are nearly all, what all reflect has to be of the same facets, lest a difference be left.
  const Bool leaves = eta < 1.0f;
  Float near = facet_sum_share(facets.alpha, true, max(eta, 1.0f / eta));
  if (accuracy == Accuracy::precise) near = select(leaves, 1.0f, near);
  const Interface interface(facets, wo, eta);
  Sums sums = VisibleFacets(wo, facets, eta)
                  .sum(recorder, lines_of(accuracy, transmits), leaves | (near > 0.0f), Sums(),
                       [&](const VisibleFacet& facet, Sums& sum) {
                         const Interface::Light light = interface.at(facet, transmits);
                         sum.share = sum.share + facet.share;
                         sum.back = sum.back + light.back;
                         sum.back_fresnel = fma(light.fresnel, light.back, sum.back_fresnel);
                         sum.forth = sum.forth + light.forth;
                         sum.forth_fresnel = fma(light.fresnel, light.forth, sum.forth_fresnel);
                       });
  const Float2 others = if_any(leaves & (near > 0.0f), Float2{0.0f, 1.0f}, [&] {
    return VisibleFacets(wo, facets, 1.0f)
        .sum(recorder, lines_of(accuracy, transmits), Bool(true), Float2{0.0f, 0.0f},
             [&](const VisibleFacet& facet, Float2& sum) {
               sum.x = sum.x + interface.at(facet, transmits).back;
               sum.y = sum.y + facet.share;
             });
  });
  // All facets are all there are to the last digit.
  const Float inverse = 1.0f / select(leaves, lerp(1.0f, others.y, near), sums.share);
  const Float scale = inverse * interface.above();
  visit(sums, [&](Float& sum) { sum = sum * scale; });
  perfect = lerp(perfect, others.x * scale, near);
  // What the sums of the same facets are apart by rounding is no light.
  const Float turned = select(leaves, max(fma(sums.back, -1.000004f, perfect), 0.0f), 0.0f);
  const Float all = sums.back + turned;
  const Float reflected = sums.back_fresnel + turned;
  return {.reflected = saturate(all),
          .fresnel = saturate(reflected / max(all, 1e-20f)),
          .passed = saturate(sums.forth),
          .total = saturate(reflected + (sums.forth - sums.forth_fresnel)),
          .turned = saturate(turned)};
}

}  // namespace

FacetSum sum_over_facets(Recorder& recorder, Accuracy accuracy, Float3 wo, const Facets& facets,
                         Float eta, Float perfect, bool transmits) {
  // One function for all lobes of a kernel.
  const bool is_ggx = facets.distribution == FacetDistribution::ggx;
  const std::string name = fmt::format("{}_{}", transmits ? "facet_sum" : "facet_reflection_sum",
                                       is_ggx ? "ggx" : "beckmann");
  const auto body = [&](Float3 from, Float2 alpha, Float index, Float albedo) {
    Facets same = facets;
    same.alpha = alpha;
    same.isotropic = false;
    return record_sum(recorder, accuracy, from, same, index, albedo, transmits);
  };
  return outline<FacetSum>(recorder, name, body, wo, facets.alpha, eta, perfect);
}

FacetReflection reflection_of_facets(Recorder& recorder, Accuracy accuracy, const Facets& facets,
                                     const LocalView& local, const FacetFresnel& fresnel,
                                     Bool inside, bool transmits) {
  const FacetView seen = facets.table_view(local);
  FacetReflection table = facet_reflection(recorder, seen);
  if (!fresnel.has_inside()) return table;
  const Float eta = relative_index(fresnel.index(), inside);
  if (!fresnel.is_dielectric()) {
    // What goes up and down with the cosine, or bends up steeply, and then is total reflection has
    // no two cosines. What it is more than a dielectric's curve has no step, and a small sum.
    const Float share = fresnel.covers_dielectric() ? fresnel.film_share() : Float(1.0f);
    table.rest_share = select((eta < 1.0f) & !facets.delta, share, 0.0f);
    table.rest = if_any(table.rest_share > 0.0f, Color3(0.0f), [&] {
      const Color3 sum = sum_of_rest(recorder, lines_of_film(accuracy), true, local.wo, facets,
                                     fresnel, eta, inside, false);
      return sum * Color3(1.0f / table.albedo);
    });
  }
  const Float dense = max(fresnel.index(), 1.0f / fresnel.index());
  Float steep = 0.0f;
  if (fresnel.covers_dielectric()) {
    steep = steepness(dense, 1.0f - fresnel.film_share());
    table = for_dielectric(recorder, seen, table, steep);
  }
  // Next to 1 no cosines stand for Fresnel's curve, nor can a table's axes tell where total
  // reflection begins. Measured, of equal roughnesses: the sum is better up to indices of 1.01
  // where light enters, of 1.025 where it leaves; not from 1.06 and 1.05 on. Of unequal ones it
  // is of light that leaves, whatever the index, for where total reflection sets in no two cosines
  // stand for all; and of curves that are steep at grazing.
  const Float stretch = seen.stretch;
  const Float where_leaving =
      max(stretch, facet_sum_share(facets.alpha, true, fma(2.0f, dense, -1.0f)));
  const Float where_entering = fresnel.covers_dielectric()
                                   ? max(facet_sum_share(facets.alpha, true, dense + 0.04f),
                                         select(steep > 0.0f, stretch, 0.0f))
                                   : Float(0.0f);
  // Nothing is recorded for an index that is known to be another.
  const bool never = where_leaving.is_constant(0.0f) && where_entering.is_constant(0.0f);
  if (!never) table.summed = select(eta < 1.0f, where_leaving, where_entering);
  Float share = table.summed;
  if (transmits) share = max(share, facet_sum_share(facets.alpha, facets.isotropic, dense));
  table.sum = if_any((share > 0.0f) & !facets.delta, table.sum, [&] {
    return sum_over_facets(recorder, accuracy, local.wo, facets, eta, table.albedo, transmits);
  });
  return table;
}

Color3 sum_over_fresnel(Recorder& recorder, Accuracy accuracy, Float3 wo, const Facets& facets,
                        const FacetFresnel& fresnel, Float eta, Bool inside) {
  // Not by whether there is a film, which nobody knows of one that may come.
  const auto lines =
      fresnel.covers_dielectric() ? lines_of_film(accuracy) : lines_of(accuracy, true);
  return sum_of_rest(recorder, lines, eta < 1.0f, wo, facets, fresnel, eta, inside, true);
}

Float facet_sum_share(Float2 alpha, bool isotropic, Float dense) {
  // All of it from ratios of 0.95 and indices of 1.05 on, none from 1 and 1.1.
  const Float near = saturate(fma(dense, -20.0f, 22.0f));
  return isotropic ? near : max(near, facet_stretch(alpha));
}

}  // namespace nacre
