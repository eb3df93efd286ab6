#include "pbs/energy.h"

#include "pbs/tables/axes.h"
#include "pbs/tables/look_up.h"

namespace nacre {

GgxView ggx_view(Float3 wo, Float2 alpha, bool isotropic) {
  const Float cosine = saturate(wo.z);
  if (isotropic) return {cosine, cosine, alpha.x};
  const Float x = alpha.x * wo.x;
  const Float y = alpha.y * wo.y;
  const Float mean = sqrt(0.5f * fma(alpha.x, alpha.x, square(alpha.y)));
  const Float z = mean * cosine;
  const Float length = sqrt(fma(x, x, fma(y, y, square(z))));
  return {cosine, saturate(z / max(length, 1e-15f)), mean};
}

GgxReflection ggx_reflection(Recorder& recorder, const GgxView& view) {
  const std::vector<Float> found =
      look_up(recorder, "ggx_reflection", ggx_reflection_table(),
              table_axes::angle(view.masked, view.alpha), table_axes::roughness(view.alpha));
  return {clamp(found[0], 0.05f, 1.0f), saturate(found[1] + view.cosine),
          saturate(found[2] + view.cosine)};
}

GgxInterface ggx_leaving(Recorder& recorder, const GgxView& view, Float eta, Float perfect) {
  const Float cosine = view.cosine;
  const Float alpha = view.alpha;
  const Float critical = table_axes::critical_cosine(eta);
  const Float angle =
      select(cosine < critical, table_axes::beyond_critical(cosine, alpha, critical),
             table_axes::within_critical(cosine, alpha, critical));
  const std::vector<Float> found = look_up(recorder, "ggx_leaving", ggx_leaving_table(), angle,
                                           table_axes::roughness(alpha), table_axes::index(eta));
  const Float mirror = table_axes::mirror_share(alpha) * fresnel_dielectric(cosine, eta);
  return {saturate(found[0] + mirror), saturate(found[1]), saturate(found[2] * perfect)};
}

GgxInterface ggx_entering(Recorder& recorder, const GgxView& view, Float eta) {
  const std::vector<Float> found = look_up(
      recorder, "ggx_entering", ggx_entering_table(), table_axes::angle(view.masked, view.alpha),
      table_axes::roughness(view.alpha), table_axes::index(eta));
  return {0.0f, saturate(found[0]), saturate(found[1])};
}

Float compensation(Float fresnel, Float albedo) {
  return fma(fresnel, (1.0f - albedo) / albedo, 1.0f);
}

Color3 compensation(Color3 fresnel, Float albedo) {
  return {compensation(fresnel.x, albedo), compensation(fresnel.y, albedo),
          compensation(fresnel.z, albedo)};
}

}  // namespace nacre
