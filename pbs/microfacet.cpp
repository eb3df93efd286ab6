#include "pbs/microfacet.h"

#include "pbs/sampling.h"

namespace nacre {

namespace {

/// Uniform on the cap z > -bottom of the unit sphere, plus wi: a normal of the
/// hemisphere. 1 + z and 1 - z are formed apart, so that neither cancels.
Float3 sample_cap(Float3 wi, Float bottom, Float u, Float v) {
  const Float span = 1.0f + bottom;
  const Float above = max(u * span, 0.0f);                                       // 1 - z
  const Float below = max(fma(1.0f - u, span, max(1.0f - bottom, 0.0f)), 0.0f);  // 1 + z
  const Float ring = sqrt(above * below);
  const Float2 on = on_circle(v);
  return {fma(ring, on.x, wi.x), fma(ring, on.y, wi.y), (1.0f - above) + wi.z};
}

/// Of any length.
Float3 normal_of_cap(Float3 wo, Float2 alpha, Float root, Float bound, Float u, Float v) {
  const Float inverse = 1.0f / max(root, 1e-30f);
  const Float3 stretched = Float3{wo.x * alpha.x, wo.y * alpha.y, wo.z} * Float3(inverse);
  const Float3 h = sample_cap(stretched, min(bound * stretched.z, 1.0f), u, v);
  return {h.x * alpha.x, h.y * alpha.y, max(h.z, 0.0f)};
}

/// Of a direction by its parts along the normal and along the surface; `least`: the less of both
/// roughnesses.
Float reflection_bound(Float z, Float across, Float least) {
  const Float a2 = square(least);
  const Float s2 = square(1.0f + across);
  return (1.0f - a2) * s2 / fma(a2, square(z), s2);
}

}  // namespace

Float ggx_distribution(Float3 h, Float2 alpha) {
  // 1 / (pi ax ay ((hx/ax)^2 + (hy/ay)^2 + hz^2)^2), its divisions multiplied out.
  const Float length2 = dot(h, h);
  const Float area = alpha.x * alpha.y;
  const Float3 q{h.x * alpha.y, h.y * alpha.x, h.z * area};
  const Float ratio = area * length2 / max(dot(q, q), 1e-30f);
  return area * square(ratio) * one_over_pi;
}

Float ggx_distribution(Float across2, Float z, Float length2, Float alpha, float scale) {
  // The above divided by alpha^2 above and below.
  const Float a2 = square(alpha);
  const Float ratio = length2 / max(fma(a2, square(z), across2), 1e-30f);
  return square(ratio) * (a2 * (scale * one_over_pi));
}

Float ggx_root(Float3 w, Float2 alpha) {
  const Float x = alpha.x * w.x;
  const Float y = alpha.y * w.y;
  return sqrt(fma(x, x, fma(y, y, square(w.z))));
}

Float ggx_root(Float z, Float alpha) {
  return sqrt(fma((1.0f - alpha) * (1.0f + alpha), square(z), square(alpha)));
}

Float ggx_masking(Float3 w, Float2 alpha) { return 2.0f * w.z / (w.z + ggx_root(w, alpha)); }

Float smith_shadowing(Float cos_o, Float root_o, Float cos_i, Float root_i) {
  return cos_i * (cos_o + root_o) / max(fma(cos_i, root_o, cos_o * root_i), 1e-30f);
}

Float3 sample_visible_normal(Float3 wo, Float2 alpha, Float root, Float u, Float v) {
  return normalize(normal_of_cap(wo, alpha, root, 1.0f, u, v));
}

Float reflection_bound(Float3 wo, Float2 alpha) {
  const Float across = sqrt(fma(wo.x, wo.x, square(wo.y)));
  return reflection_bound(wo.z, across, min(alpha.x, alpha.y));
}

Float reflection_bound(Float z, Float alpha) {
  return reflection_bound(z, safe_sqrt((1.0f - z) * (1.0f + z)), alpha);
}

Float3 sample_reflecting_normal(Float3 wo, Float2 alpha, Float root, Float bound, Float u,
                                Float v) {
  return normal_of_cap(wo, alpha, root, bound, u, v);
}

Float3 reflect_about(Float3 w, Float3 h) {
  const Float length2 = dot(h, h);
  const Float twice = select(length2 > 0.0f, 2.0f * dot(w, h) / length2, 0.0f);
  return {fma(twice, h.x, -w.x), fma(twice, h.y, -w.y), fma(twice, h.z, -w.z)};
}

Float3 reflect(Float3 w, Float3 h) {
  const Float twice = 2.0f * dot(w, h);
  return {fma(twice, h.x, -w.x), fma(twice, h.y, -w.y), fma(twice, h.z, -w.z)};
}

}  // namespace nacre
