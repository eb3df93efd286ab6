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
  equal.wide_masked = cosine;
  equal.wide = max(alpha.x, alpha.y);
  equal.ratio = min(alpha.x, alpha.y) / equal.wide;
  const Bool is_stretched = alpha.x != alpha.y;
  const Float mean = sqrt(0.5f * fma(alpha.x, alpha.x, square(alpha.y)));
  equal.alpha = select(is_stretched, mean, alpha.x);
  // Materials whose roughness varies are mostly equal on both axes.
  return if_any(is_stretched, equal, [&] {
    const Float x2 = square(alpha.x * wo.x);
    const Float y2 = square(alpha.y * wo.y);
    const auto masked = [&](Float roughness) {
      const Float z = roughness * cosine;
      return saturate(z / max(sqrt(x2 + y2 + square(z)), 1e-15f));
    };
    FacetView stretched = equal;
    stretched.masked = masked(mean);
    stretched.wide_masked = masked(equal.wide);
    const Float narrow2 = select(alpha.x < alpha.y, x2, y2);
    stretched.across = narrow2 / max(x2 + y2, 1e-30f);
    return stretched;
  });
}

namespace {

/// The albedo of one roughness, and what the narrower axis adds: nothing where both are equal, so
/// that a surface is the same whether that is known or not.
Float stretched_albedo(Recorder& recorder, const FacetView& view) {
  const FacetTables& tables = facet_tables(view.distribution);
  const Float roughness = table_axes::roughness(view.wide);
  const std::vector<Float> equal = look_up(
      recorder, tables.reflection, table_axes::angle(view.wide_masked, view.wide), roughness);
  const std::vector<Float> more =
      look_up(recorder, tables.stretched, table_axes::stretched_angle(view.wide_masked, view.wide),
              roughness, sqrt(view.ratio));
  // Measured: the change begins at once and levels off.
  return equal[0] + lerp(more[0], more[1], view.across * (2.0f - view.across));
}

}  // namespace

FacetReflection facet_reflection(Recorder& recorder, const FacetView& view) {
  const std::vector<Float> found =
      look_up(recorder, facet_tables(view.distribution).reflection,
              table_axes::angle(view.masked, view.alpha), table_axes::roughness(view.alpha));
  Float albedo = found[0];
  if (view.anisotropic) {
    albedo = if_any(view.ratio < 1.0f, albedo, [&] { return stretched_albedo(recorder, view); });
  }
  return {clamp(albedo, 0.05f, 1.0f), saturate(found[1] + view.cosine),
          saturate(found[2] + view.cosine)};
}

FacetReflection for_dielectric(Recorder& recorder, const FacetView& view,
                               const FacetReflection& reflection, Float index, Float bare) {
  // Measured: what exponent of 1 - cosine the factor is most like.
  const Float near =
      bare * clamp(0.44f * (1.0f / sqrt(max(index - 1.0f, 1e-6f)) - 1.8f), 0.0f, 2.0f);
  return if_any(near > 0.0f, reflection, [&] {
    const std::vector<Float> steep =
        look_up(recorder, facet_tables(view.distribution).steep,
                table_axes::angle(view.masked, view.alpha), table_axes::roughness(view.alpha));
    FacetReflection better = reflection;
    better.low = saturate(lerp(reflection.low, saturate(steep[0] + view.cosine), near));
    better.high = saturate(lerp(reflection.high, saturate(steep[1] + view.cosine), near));
    return better;
  });
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
