#include "pbs/fresnel.h"

namespace nacre {

namespace {

constexpr float tiny = 1e-30f;

/// eta^2 - 1 without cancellation.
Float excess(Float eta) {
  const Float e = eta - 1.0f;
  return e * (eta + 1.0f);
}

Float raise(Float x, Float exponent) {
  if (exponent.is_constant(5.0f)) return square(square(x)) * x;
  if (exponent.is_constant(1.0f)) return x;
  return pow(x, exponent);
}

constexpr float dip_cosine = 1.0f / 7.0f;

}  // namespace

Bool totally_reflected(Float cosine, Float eta) {
  const Float d = excess(eta);
  return (fma(cosine, cosine, d) <= 0.0f) & (d != 0.0f);
}

Polarised fresnel_dielectric_polarised(Float cosine, Float eta) {
  const Float d = excess(eta);
  const Float cosine2 = square(cosine);
  const Float g = safe_sqrt(fma(cosine, cosine, d));
  const Float eta2 = square(eta);
  // Over their common denominator, by one division; of any eta that
  // is not 1 both are above 1e-12.
  const Float below_s = max(square(cosine + g), 1e-15f);
  const Float below_p = max(square(fma(eta2, cosine, g)), 1e-15f);
  const Float over = d / (below_s * below_p);
  const Float s = over * below_p;
  const Float p = over * below_s * fma(cosine2, eta2 + 1.0f, -1.0f);
  const Bool total = totally_reflected(cosine, eta);
  return {select(total, 1.0f, min(square(s), 1.0f)), select(total, 1.0f, min(square(p), 1.0f))};
}

Float fresnel_dielectric(Float cosine, Float eta) {
  // The mean of the above over one denominator: s = d / t^2 and p = s x / e, where t (c t - 1) is
  // x.
  const Float d = excess(eta);
  const Float g = safe_sqrt(fma(cosine, cosine, d));
  const Float t = cosine + g;
  const Float x = t * fma(cosine, t, -1.0f);
  const Float e = fma(square(eta), cosine, g);
  const Float above = 0.5f * square(d) * fma(x, x, square(e));
  const Float below = square(square(t) * e);
  const Bool total = totally_reflected(cosine, eta);
  return select(total, 1.0f, min(above / max(below, 1e-37f), 1.0f));
}

Polarised fresnel_conductor_polarised(Float cosine, Float n, Float k) {
  const Float cosine2 = square(cosine);
  const Float sine2 = max(1.0f - cosine2, 0.0f);
  // (a + ib)^2 = (n + ik)^2 - sin^2. Its real part by what keeps the digits of the cosine where
  // that is small or n near 1: there, where k = 0, nothing is reflected, and n^2 - sin^2 has none
  // of them; by the other where n and k are small, and sin^2 too, which 1 - cos^2 has no digits of.
  // The greater of a and b from the sum that does not cancel, the other from their product n k.
  const Float grazing = fma(cosine, cosine, fma(-k, k, excess(n)));
  const Bool by_cosine = (cosine2 < 0.25f) | (n > 0.9f);
  const Float t = select(by_cosine, grazing, fma(n - k, n + k, -sine2));
  const Float product = n * k;
  const Float product2 = square(product);
  const Float modulus = sqrt(fma(t, t, 4.0f * product2));
  const Float greater2 = 0.5f * (modulus + abs(t));
  const Float greater = sqrt(greater2);
  const Bool mostly_real = t > 0.0f;
  // Times the greater: so the other needs no division, nor does anything but the whole, over the
  // common denominator of r_s^2 and r_p^2 / r_s^2.
  const Float a = select(mostly_real, greater2, product);
  const Float b2 = select(mostly_real, product2, square(greater2)) + tiny;
  const Float sum_s = fma(cosine, greater, a);
  // Where n = 1 and k = 0 the greater is the cosine itself, to the bit, and nothing is reflected.
  const Float difference_s =
      select(mostly_real, greater * (greater - cosine), fma(-cosine, greater, a));
  const Float below_s = fma(sum_s, sum_s, b2);
  const Float above_s = fma(difference_s, difference_s, b2);
  const Float slope = sine2 * greater;
  const Float sum_p = fma(a, cosine, slope), difference_p = fma(a, cosine, -slope);
  const Float bc2 = fma(b2, cosine2, tiny);
  const Float below_p = fma(sum_p, sum_p, bc2);
  const Float above_p = fma(difference_p, difference_p, bc2);
  // The first is 1 at least where the other is small.
  const Bool is_none = by_cosine & (above_s <= tiny);
  const Float s = select(is_none, 0.0f, above_s) / (below_s * below_p);
  return {min(s * below_p, 1.0f), min(s * above_p, 1.0f)};
}

Color3 fresnel_conductor(Float cosine, Color3 n, Color3 k) {
  return {fresnel_conductor_polarised(cosine, n.x, k.x).mean(),
          fresnel_conductor_polarised(cosine, n.y, k.y).mean(),
          fresnel_conductor_polarised(cosine, n.z, k.z).mean()};
}

SchlickCurve::SchlickCurve(Color3 c0, Color3 c82, Color3 c90, Float power)
    : color0(saturate(c0)), color90(saturate(c90)), exponent(clamp(power, 0.0f, 1000.0f)) {
  const Float x = raise(1.0f - dip_cosine, exponent);
  const float falloff = 1.0f - dip_cosine;
  const float scale =
      1.0f / (dip_cosine * falloff * falloff * falloff * falloff * falloff * falloff);
  const auto channel = [&](Float a, Float b, Float at82) {
    const Float rest = 1.0f - saturate(at82);
    return rest.is_constant(0.0f) ? Float(0.0f) : lerp(a, b, x) * rest * scale;
  };
  dip = {channel(color0.x, color90.x, c82.x), channel(color0.y, color90.y, c82.y),
         channel(color0.z, color90.z, c82.z)};
}

Color3 SchlickCurve::at(Float cosine) const {
  const Float rest = max(1.0f - cosine, 0.0f);
  const Float x = raise(rest, exponent);
  const Float bump = cosine * square(square(rest) * rest);
  const auto channel = [&](Float a, Float b, Float depth) {
    if (a.is_constant(1.0f) && b.is_constant(1.0f) && depth.is_constant(0.0f)) return Float(1.0f);
    const Float plain = lerp(a, b, x);
    return depth.is_constant(0.0f) ? plain : saturate(fma(-depth, bump, plain));
  };
  return {channel(color0.x, color90.x, dip.x), channel(color0.y, color90.y, dip.y),
          channel(color0.z, color90.z, dip.z)};
}

Color3 SchlickCurve::mean() const {
  const Float share = 2.0f / ((exponent + 1.0f) * (exponent + 2.0f));
  return saturate(lerp(color0, color90, share) - dip * Color3(1.0f / 126.0f));
}

Float reflectance_of_index(Float eta) { return square((eta - 1.0f) / (eta + 1.0f)); }

Float index_of_reflectance(Float reflectance, float most) {
  const Float root = sqrt(clamp(reflectance, 0.01f, most));
  return (1.0f + root) / (1.0f - root);
}

}  // namespace nacre
