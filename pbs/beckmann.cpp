#include "pbs/beckmann.h"

#include "pbs/sampling.h"

namespace nacre {

namespace {

constexpr float root_pi = 1.77245385090551602730f;
constexpr float one_over_root_pi = 0.564189583547756286948f;

/// erf(x) for x >= 0, to 1.5e-7; `gauss` is exp(-x^2). Abramowitz and Stegun 7.1.26.
Float erf_of_positive(Float x, Float gauss) {
  const Float t = 1.0f / fma(0.3275911f, x, 1.0f);
  Float p = fma(1.061405429f, t, -1.453152027f);
  p = fma(p, t, 1.421413741f);
  p = fma(p, t, -0.284496736f);
  p = fma(p, t, 0.254829592f);
  return fma(-(p * t), gauss, 1.0f);
}

/// x with erf(x) = y for |y| <= `most`, to 3e-7 of it: x / y over w = -log(1 - y^2), as Giles does
/// ("Approximating the erfinv Function", GPU Computing Gems Jade Edition, 2011), whose two
/// polynomials, and the root between them, are one here, for w is at most 12.5: interpolated at
/// Chebyshev's nodes.
Float inverse_erf(Float y) {
  const Float w = -log((1.0f - y) * (1.0f + y)) - 6.25f;
  Float p = 8.85424123e-13f;
  for (const float coefficient :
       {-3.48452637e-12f, -1.30206113e-10f, 9.97207996e-10f, 2.04101629e-09f, -6.3175616e-08f,
        6.03492555e-07f, -4.12034219e-06f, 8.37281067e-06f, 0.000266167058f, -0.00645098466f,
        0.1964554f, 2.33594558f}) {
    p = fma(p, w, coefficient);
  }
  return p * y;
}

/// erf of the largest slope that is sampled: what lies beyond is 1e-6 of the facets.
constexpr float most = 0.999998f;
constexpr float most_slope = 3.3607f;

/// The slope along a view of that cosine and sine, of a surface of roughness 1: its density is
/// exp(-x^2) (cosine - x sine), as far as facets face the view.
///
/// Sought where the share of facets below it is u, from a guess that is off by .05 at most: Jakob,
/// "An Improved Visible Normal Sampling Routine for the Beckmann Distribution", 2014, whose power
/// of the angle is fitted by one of its sine here. A step of Halley's by the slope's error
/// function, which tails need, leaves 8e-5, and one by the slope less than float can tell: no loop.
Float sample_slope(Float cosine, Float sine, Float u) {
  const Float steepest = min(cosine / max(sine, 1e-6f), 4.0f);
  const Float gauss = exp(-square(steepest));
  const Float top = min(erf_of_positive(steepest, gauss), most);
  // The share of facets below a slope x is ((1 + erf x) cosine sqrt(pi) + sine exp(-x^2)) / whole.
  const Float flat = cosine * root_pi;
  const Float wanted = u * fma(flat, 1.0f + top, sine * gauss);
  const auto quotient = [](Float a, Float b) { return select(b > 0.0f, a / b, 0.0f); };

  const Float power = fma(sine, fma(sine, 0.29f, -0.848f), 1.0f);
  const Float guess = fma(-(1.0f + top), exp(power * log(max(1.0f - u, 1e-7f))), top);
  const Float y = clamp(guess, -most, top);
  const Float x = inverse_erf(y);
  const Float e = exp(-square(x));
  const Float seen = fma(-x, sine, cosine);
  const Float excess = fma(flat, 1.0f + y, sine * e) - wanted;
  const Float step = quotient(4.0f * one_over_root_pi * excess * seen * e,
                              fma(4.0f * square(seen), e, excess * sine));

  const Float next_y = clamp(y - step, -most, top);
  const Float next = inverse_erf(next_y);
  const Float next_e = exp(-square(next));
  const Float next_seen = fma(-next, sine, cosine);
  const Float left = fma(flat, 1.0f + next_y, sine * next_e) - wanted;
  const Float last =
      quotient(2.0f * left * next_seen,
               fma(4.0f * square(next_seen), next_e, left * fma(2.0f * next, next_seen, sine)));
  return clamp(next - last, -most_slope, min(steepest, most_slope));
}

/// `slope2`: the square of the slope, over roughness, times z^2.
Float distribution(Float slope2, Float z, Float length2, Float area) {
  const Float z2 = max(square(z), 1e-12f * length2);
  const Float inverse = 1.0f / max(z2, 1e-30f);
  return exp(-(slope2 * inverse)) * square(length2 * inverse) * one_over_pi / area;
}

/// `across`: what is seen of the roughness, which is more at grazing.
Float root(Float z, Float across) {
  const Float a = min(z / max(across, 1e-30f), 8.0f);
  const Float gauss = exp(-square(a));
  return fma(z, erf_of_positive(a, gauss), across * gauss * one_over_root_pi);
}

}  // namespace

Float beckmann_distribution(Float3 h, Float2 alpha) {
  const Float x = h.x / alpha.x;
  const Float y = h.y / alpha.y;
  return distribution(fma(x, x, square(y)), h.z, dot(h, h), alpha.x * alpha.y);
}

Float beckmann_distribution(Float across2, Float z, Float length2, Float alpha) {
  const Float area = square(alpha);
  return distribution(across2 / area, z, length2, area);
}

Float beckmann_root(Float3 w, Float2 alpha) {
  const Float x = alpha.x * w.x;
  const Float y = alpha.y * w.y;
  return root(abs(w.z), sqrt(fma(x, x, square(y))));
}

Float beckmann_root(Float z, Float alpha) {
  return root(abs(z), alpha * safe_sqrt((1.0f - z) * (1.0f + z)));
}

Float3 sample_visible_beckmann(Float3 wo, Float2 alpha, Float u, Float v) {
  const Float3 stretched = normalize({wo.x * alpha.x, wo.y * alpha.y, wo.z});
  const Float sine2 = fma(stretched.x, stretched.x, square(stretched.y));
  const Float sine = sqrt(sine2);
  const Bool slanted = sine2 > 1e-14f;
  const Float inverse = 1.0f / max(sine, 1e-7f);
  const Float2 along{select(slanted, stretched.x * inverse, 1.0f),
                     select(slanted, stretched.y * inverse, 0.0f)};
  const Float forth = sample_slope(stretched.z, sine, u);
  const Float aside = inverse_erf(clamp(fma(v, 2.0f, -1.0f), -most, most));
  // Facets that face the view fall off towards it.
  const Float x = fma(along.x, forth, -(along.y * aside));
  const Float y = fma(along.y, forth, along.x * aside);
  return normalize({-(x * alpha.x), -(y * alpha.y), Float(1.0f)});
}

}  // namespace nacre
