#include "pbs/beckmann.h"

#include "pbs/sampling.h"
#include "runtime/value/control.h"

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

/// x with erf(x) = y for y in (-1, 1), to 1e-6 of it. Giles, "Approximating the erfinv Function",
/// GPU Computing Gems Jade Edition, 2011, single precision.
Float inverse_erf(Float y) {
  const Float w = -log((1.0f - y) * (1.0f + y));
  const auto polynomial = [](Float x, const auto&... coefficients) {
    Float p = 0.0f;
    ((p = fma(p, x, coefficients)), ...);
    return p;
  };
  const Float centre =
      polynomial(w - 2.5f, 2.81022636e-08f, 3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f,
                 0.00021858087f, -0.00125372503f, -0.00417768164f, 0.246640727f, 1.50140941f);
  const Float tail = polynomial(sqrt(max(w, 5.0f)) - 3.0f, -0.000200214257f, 0.000100950558f,
                                0.00134934322f, -0.00367342844f, 0.00573950773f, -0.0076224613f,
                                0.00943887047f, 1.00167406f, 2.83297682f);
  return select(w < 5.0f, centre, tail) * y;
}

/// Where the slope is sought, by its error function.
struct Bracket {
  Float low, high, at;
  template <class F>
  friend void visit(Bracket& bracket, F&& f) {
    f(bracket.low), f(bracket.high), f(bracket.at);
  }
};

/// erf of the largest slope that is sampled: what lies beyond is 1e-6 of the facets.
constexpr float most = 0.999998f;

/// The slope along a view of that cosine and sine, of a surface of roughness 1: its density is
/// exp(-x^2) (cosine - x sine), as far as facets face the view.
Float sample_slope(Recorder& recorder, Float cosine, Float sine, Float u) {
  const Float steepest = min(cosine / max(sine, 1e-6f), 4.0f);
  const Float gauss = exp(-square(steepest));
  const Float top = min(erf_of_positive(steepest, gauss), most);
  // The share of facets below a slope x is ((1 + erf x) cosine sqrt(pi) + sine exp(-x^2)) / whole.
  const Float flat = cosine * root_pi;
  const Float whole = fma(flat, 1.0f + top, sine * gauss);
  const Float wanted = u * whole;
  const Bracket start{-most, top, fma(u, top + most, -most)};
  const Bracket found = loop(recorder, Bool(true), 12, start, [&](Int, Bracket& bracket) {
    const Float x = inverse_erf(bracket.at);
    const Float excess = fma(flat, 1.0f + bracket.at, sine * exp(-square(x))) - wanted;
    const Bool above = excess > 0.0f;
    bracket.high = select(above, bracket.at, bracket.high);
    bracket.low = select(above, bracket.low, bracket.at);
    // By erf, whose derivative divides out: d(share) = sqrt(pi) (cosine - x sine) d(erf).
    const Float slope = root_pi * fma(-x, sine, cosine);
    const Float next = bracket.at - excess / max(slope, 1e-6f);
    const Bool inside = (next >= bracket.low) & (next <= bracket.high);
    bracket.at = select(inside, next, 0.5f * (bracket.low + bracket.high));
    return abs(excess) > 1e-6f * whole;
  });
  return inverse_erf(clamp(found.at, -most, most));
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

Float3 sample_visible_beckmann(Recorder& recorder, Float3 wo, Float2 alpha, Float u, Float v) {
  const Float3 stretched = normalize({wo.x * alpha.x, wo.y * alpha.y, wo.z});
  const Float sine2 = fma(stretched.x, stretched.x, square(stretched.y));
  const Float sine = sqrt(sine2);
  const Bool slanted = sine2 > 1e-14f;
  const Float inverse = 1.0f / max(sine, 1e-7f);
  const Float2 along{select(slanted, stretched.x * inverse, 1.0f),
                     select(slanted, stretched.y * inverse, 0.0f)};
  const Float forth = sample_slope(recorder, stretched.z, sine, u);
  const Float aside = inverse_erf(clamp(fma(v, 2.0f, -1.0f), -most, most));
  // Facets that face the view fall off towards it.
  const Float x = fma(along.x, forth, -(along.y * aside));
  const Float y = fma(along.y, forth, along.x * aside);
  return normalize({-(x * alpha.x), -(y * alpha.y), Float(1.0f)});
}

}  // namespace nacre
