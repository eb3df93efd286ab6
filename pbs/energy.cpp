#include "pbs/energy.h"

#include "pbs/tables/axes.h"
#include "pbs/tables/facet_tables.h"
#include "pbs/tables/look_up.h"
#include "runtime/value/control.h"

namespace nacre {

FacetView facet_view(Float3 wo, FacetDistribution distribution, Float2 alpha, bool isotropic) {
  const Float cosine = saturate(wo.z);
  FacetView equal{
      .distribution = distribution, .cosine = cosine, .masked = cosine, .alpha = alpha.x};
  if (isotropic) return equal;
  equal.anisotropic = true;
  equal.stretch = facet_stretch(alpha);
  const Bool is_stretched = alpha.x != alpha.y;
  const Float mean = sqrt(0.5f * fma(alpha.x, alpha.x, square(alpha.y)));
  equal.alpha = select(is_stretched, mean, alpha.x);
  // Materials whose roughness varies are mostly equal on both axes.
  return if_any(is_stretched, equal, [&] {
    const Float a2 = square(alpha.x), b2 = square(alpha.y);
    const Float x2 = square(wo.x), y2 = square(wo.y);
    const Float slant2 = fma(a2, x2, b2 * y2);
    const Float z = mean * cosine;
    FacetView stretched = equal;
    stretched.masked = saturate(z / max(sqrt(fma(z, z, slant2)), 1e-15f));
    // A view from straight above has no sides: one is taken.
    const Float sine2 = x2 + y2;
    const Bool slanted = sine2 > 1e-30f;
    const Float inverse = 1.0f / max(sine2, 1e-30f);
    const Float along2 = select(slanted, slant2 * inverse, a2);
    const Float across2 = select(slanted, fma(a2, y2, b2 * x2) * inverse, b2);
    stretched.along = sqrt(along2);
    stretched.across = sqrt(across2);
    const Float turned2 = square((a2 - b2) * inverse) * x2 * y2;
    stretched.correlation2 = saturate(turned2 / max(along2 * across2, 1e-30f));
    return stretched;
  });
}

Float facet_stretch(Float2 alpha) {
  const Float wide = max(alpha.x, alpha.y), narrow = min(alpha.x, alpha.y);
  return saturate(20.0f * (wide - narrow) / wide);
}

namespace {

/// Of perfect facets: the albedo, and the cosines of the darker and the brighter half of the light,
/// less that of the view.
std::vector<Float> reflected(Recorder& recorder, const FacetView& view, Float cosine, Float alpha) {
  return look_up(recorder, facet_tables(view.distribution).reflection,
                 table_axes::angle(cosine, alpha), table_axes::roughness(alpha));
}

/// The same of unequal roughness.
std::vector<Float> reflected_by_unequal(Recorder& recorder, const FacetView& view) {
  std::vector<Float> all = reflected(recorder, view, view.cosine, view.along);
  const FacetTable& table = facet_tables(view.distribution).unequal;
  const Float along = table_axes::roughness(view.along);
  const Float across = table_axes::roughness(view.across);
  const std::vector<Float> more =
      look_up(recorder, table, table_axes::unequal_angle(view.cosine, view.along, view.across),
              along, across);
  // Measured: not quite linear, a little less at first.
  const Float turned = view.correlation2 * fma(0.5f, view.correlation2, 0.5f);
  // Towards mirrors, within the first cell, cosines change as roughness does and not as its root.
  const Float fades = saturate(max(along, across) * Float(table.roughnesses - 1));
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Float change = lerp(more[k], more[k + all.size()], turned);
    all[k] = k == 0 ? all[k] + change : fma(fades, change, all[k]);
  }
  return all;
}

}  // namespace

FacetSum lerp(const FacetSum& a, const FacetSum& b, Float t) {
  return {nacre::lerp(a.reflected, b.reflected, t), nacre::lerp(a.fresnel, b.fresnel, t),
          nacre::lerp(a.passed, b.passed, t), nacre::lerp(a.total, b.total, t),
          nacre::lerp(a.turned, b.turned, t)};
}

FacetReflection facet_reflection(Recorder& recorder, const FacetView& view) {
  const auto cosines = [&](const std::vector<Float>& all) {
    return FacetReflection{clamp(all[0], 0.05f, 1.0f), saturate(all[1] + view.cosine),
                           saturate(all[2] + view.cosine)};
  };
  const auto of_equal = [&] { return cosines(reflected(recorder, view, view.masked, view.alpha)); };
  if (!view.anisotropic) return of_equal();
  // Nothing is added where both are equal: a surface is the same whether that is known or not.
  const FacetReflection none{1.0f, 1.0f, 1.0f};
  const FacetReflection equal = if_any(view.stretch < 1.0f, none, of_equal);
  // Cosines are said to be such behind the region, where a table of Fresnel's factors may be made.
  const FacetReflection both = if_any(view.stretch > 0.0f, equal, [&] {
    const FacetReflection unequal = cosines(reflected_by_unequal(recorder, view));
    return FacetReflection{lerp(equal.albedo, unequal.albedo, view.stretch),
                           lerp(equal.low, unequal.low, view.stretch),
                           lerp(equal.high, unequal.high, view.stretch)};
  });
  return {both.albedo, saturate(both.low), saturate(both.high)};
}

Float steepness(Float index, Float bare) {
  // Measured: what exponent of 1 - cosine the factor is most like.
  return bare * clamp(0.44f * (1.0f / sqrt(max(index - 1.0f, 1e-6f)) - 1.8f), 0.0f, 2.0f);
}

FacetReflection for_dielectric(Recorder& recorder, const FacetView& view,
                               const FacetReflection& reflection, Float steepness) {
  const FacetReflection found = if_any(steepness > 0.0f, reflection, [&] {
    const std::vector<Float> steep =
        look_up(recorder, facet_tables(view.distribution).steep,
                table_axes::angle(view.masked, view.alpha), table_axes::roughness(view.alpha));
    FacetReflection better = reflection;
    better.low = lerp(reflection.low, saturate(steep[0] + view.cosine), steepness);
    better.high = lerp(reflection.high, saturate(steep[1] + view.cosine), steepness);
    return better;
  });
  return {found.albedo, saturate(found.low), saturate(found.high)};
}

FacetInterface facet_leaving(Recorder& recorder, const FacetView& view, Float eta, Float perfect) {
  const Float cosine = view.cosine;
  const Float alpha = view.alpha;
  const Float critical = table_axes::critical_cosine(eta);
  const Float angle =
      select(cosine < critical, table_axes::beyond_critical(cosine, alpha, critical),
             table_axes::within_critical(cosine, alpha, critical));
  const std::vector<Float> found = look_up(recorder, facet_tables(view.distribution).leaving, angle,
                                           table_axes::roughness(alpha), table_axes::index(eta));
  const Float mirror = table_axes::mirror_share(alpha) * fresnel_dielectric(cosine, eta);
  return {saturate(found[0] + mirror), saturate(found[1]), saturate(found[2] * perfect),
          saturate(found[3] * perfect)};
}

FacetInterface facet_entering(Recorder& recorder, const FacetView& view, Float eta) {
  const std::vector<Float> found =
      look_up(recorder, facet_tables(view.distribution).entering,
              table_axes::entering_angle(view.masked, view.alpha),
              table_axes::roughness(view.alpha), table_axes::index(eta));
  return {0.0f, saturate(found[0]), saturate(found[1]), 0.0f};
}

Float compensation(Float fresnel, Float albedo) {
  return fma(fresnel, (1.0f - albedo) / albedo, 1.0f);
}

Color3 compensation(Color3 fresnel, Float albedo) {
  return {compensation(fresnel.x, albedo), compensation(fresnel.y, albedo),
          compensation(fresnel.z, albedo)};
}

}  // namespace nacre
