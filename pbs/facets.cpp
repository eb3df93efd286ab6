#include "pbs/facets.h"

#include <array>

#include "pbs/beckmann.h"
#include "pbs/microfacet.h"
#include "pbs/per_view.h"
#include "runtime/node/geometry.h"

namespace nacre {

LocalView Facets::look(const View& view) const {
  Frame frame = has_tangent ? make_frame(normal, tangent) : make_frame(normal);
  Float3 wo = frame.to_local(view.wo);
  const Bool below = wo.z < 0.0f;
  // x and y may stay: the lobes are even in both.
  frame.z = select(below, -normal, normal);
  wo.z = min(abs(wo.z), 1.0f);  // facing_cosine().
  return {frame, wo, below};
}

Facets Facets::upright() const {
  Facets turned = *this;
  turned.normal = {0.0f, 0.0f, 1.0f};
  turned.tangent = {1.0f, 0.0f, 0.0f};
  return turned;
}

bool Facets::may_be_equal(const Recorder& recorder) const {
  const bool is_known = alpha.x.is_constant() && alpha.y.is_constant();
  return !isotropic && !is_known && !recorder.is_varying(alpha.x.ref()) &&
         !recorder.is_varying(alpha.y.ref());
}

Facets Facets::as_equal() const {
  Facets equal = *this;
  equal.isotropic = true;
  equal.has_tangent = false;
  equal.alpha.y = alpha.x;
  return equal;
}

bool have_one_frame(const Facets& a, const Facets& b) {
  return a.distribution == b.distribution && a.isotropic == b.isotropic &&
         a.has_tangent == b.has_tangent && same_value(a.normal, b.normal) &&
         (!a.has_tangent || same_value(a.tangent, b.tangent));
}

FacetDirection Facets::viewer(const View& view, const LocalView& local) const {
  return isotropic ? FacetDirection(view.wo, local.wo.z) : FacetDirection(local.wo);
}

FacetDirection Facets::direction(const LocalView& local, Float3 world) const {
  if (!isotropic) return local.frame.to_local(world);
  return {world, dot(world, local.frame.z)};
}

HalfVector Facets::between(const LocalView& local, const FacetDirection& wo,
                           const FacetDirection& wi, Float ratio) const {
  const Float3 v = fma(wi.v, Float3(ratio), wo.v);
  const Float length2 = dot(v, v);
  if (!isotropic) return {v, length2, 0.0f};
  // The length of a product with the normal and no difference of squares: all digits of slopes that
  // are narrow.
  const Float3 across = cross(local.frame.z, v);
  return {{v, fma(wi.z, ratio, wo.z)}, length2, dot(across, across)};
}

FacetDirection Facets::mirrored(const LocalView& local, const FacetDirection& w) const {
  if (!isotropic) return Float3(w.v.x, w.v.y, -w.z);
  return {fma(local.frame.z, Float3(-2.0f * w.z), w.v), -w.z};
}

FacetDirection Facets::turned(const LocalView& local, const FacetDirection& w) const {
  if (!isotropic) return Float3(-w.v.x, -w.v.y, w.z);
  return {fma(local.frame.z, Float3(2.0f * w.z), -w.v), w.z};
}

Float Facets::density(const HalfVector& half, float scale) const {
  if (distribution == FacetDistribution::beckmann) {
    return Float(scale) *
           (isotropic ? beckmann_distribution(half.across2, half.h.z, half.length2, alpha.x)
                      : beckmann_distribution(half.h.v, alpha));
  }
  return isotropic ? ggx_distribution(half.across2, half.h.z, half.length2, alpha.x, scale)
                   : Float(scale) * ggx_distribution(half.h.v, alpha);
}

Float Facets::root(const FacetDirection& w) const {
  const bool is_ggx = distribution == FacetDistribution::ggx;
  if (isotropic) return is_ggx ? ggx_root(w.z, alpha.x) : beckmann_root(w.z, alpha.x);
  return is_ggx ? ggx_root(w.v, alpha) : beckmann_root(w.v, alpha);
}

Float Facets::bound(const FacetDirection& wo) const {
  if (distribution != FacetDistribution::ggx) return 1.0f;
  return isotropic ? reflection_bound(wo.z, alpha.x) : reflection_bound(wo.v, alpha);
}

Float3 Facets::sample_visible(Float3 wo, Float u, Float v) const {
  return distribution == FacetDistribution::ggx ? sample_visible_normal(wo, alpha, root(wo), u, v)
                                                : sample_visible_beckmann(wo, alpha, u, v);
}

Float3 Facets::sample_reflecting(Float3 wo, Float u, Float v) const {
  return distribution == FacetDistribution::ggx
             ? sample_reflecting_normal(wo, alpha, root(wo), bound(wo), u, v)
             : sample_visible_beckmann(wo, alpha, u, v);
}

Facets prepare_facets(NodeCall& call) {
  Recorder& recorder = call.recorder();
  Float2 roughness = call.vector2("roughness");
  const float threshold = call.accuracy() == Accuracy::fast ? 1e-3f : 1e-4f;
  // What differs by roundings is equal: `fast` computes each of two in an order of its own, and
  // what facets of equal roughness take is far less.
  if (!same_value(roughness.x.ref(), roughness.y.ref())) {
    const Bool are_alike = abs(roughness.x - roughness.y) <= 1e-6f * abs(roughness.x);
    roughness.y = select(are_alike, roughness.x, roughness.y);
  }
  const bool isotropic = same_value(roughness.x.ref(), roughness.y.ref());
  if (recorder.has_leaf("min_alpha")) {
    const Float least(recorder.parameter("min_alpha", Scalar::f32, 0));
    roughness = {max(roughness.x, least), max(roughness.y, least)};
  }
  const auto clamped = [&](Float x) { return keep(recorder, clamp(x, threshold, 1.0f)); };
  return {.distribution = call.text("distribution") == "beckmann" ? FacetDistribution::beckmann
                                                                  : FacetDistribution::ggx,
          .alpha = {clamped(roughness.x), clamped(roughness.y)},
          .delta = keep(recorder, !((roughness.x >= threshold) | (roughness.y >= threshold))),
          .threshold = threshold,
          .isotropic = isotropic,
          .normal = prepare_facing_normal(recorder, call.vector3("normal")),
          .tangent = isotropic ? Float3(0.0f) : keep(recorder, call.vector3("tangent")),
          .has_tangent = !isotropic};
}

namespace {

/// Where `given` is not the shading normal itself: it, unit, or that one if it is zero or NaN.
Float3 unit_normal(Float3 given, Float3 shading) {
  const Float squared = dot(given, given);
  const Bool usable = (squared > 1e-30f) & (squared < 1e30f);
  return select(usable, given * Float3(1.0f / sqrt(squared)), shading);
}

}  // namespace

Float3 prepare_normal(Recorder& recorder, Float3 given) {
  const Float3 shading = normal(recorder, Space::world);
  if (same_value(given, shading)) return given;
  return keep(recorder, unit_normal(given, shading));
}

Float3 prepare_facing_normal(Recorder& recorder, Float3 given) {
  const Float3 shading = normal(recorder, Space::world);
  if (same_value(given, shading)) return given;
  const Float3 unit = unit_normal(given, shading);
  const Float3 geometric = geometric_normal(recorder);
  const Float3 wo = view_direction(recorder);
  const Float seen = dot(unit, wo);
  const Float squared = dot(wo, wo);
  // A unit vector stays one whatever the length of wo.
  const Bool usable = (squared > 1e-30f) & (squared < 1e30f);
  const Bool away = (seen * dot(geometric, wo) < 0.0f) & (dot(geometric, unit) > 0.0f) & usable;
  return keep(recorder, select(away, unit - wo * Float3(2.0f * seen / squared), unit));
}

Float relative_index(Float index, Bool inside) { return select(inside, 1.0f / index, index); }

Bool goes_straight(Float index) { return abs(index - 1.0f) < 1e-3f; }

namespace {

/// c (1 - c)^6 as the cosines of both halves have it, less its mean over the light. The root of the
/// mean of y^k, y = 1 - c, is known of each half for k = 5.4 and, from the steep table, for 10; how
/// far between these k = 6 and 7 lie is fitted to quadrature. With it white below the deepest dip
/// is white to 1 % (tests/pbs/battery/furnace_schlick_test.cpp); by the cosines alone it gains 5 %.
Float excess_of_dip(Recorder& recorder, const FacetReflection& reflection, const FacetView& view) {
  const FacetReflection steep = for_dielectric(recorder, view, reflection, 1.0f);
  const auto of_half = [](Float cosine, Float steep_cosine) {
    const Float y = 1.0f - cosine, apart = cosine - steep_cosine;
    const Float sixth = fma(apart, 0.175f, y), seventh = fma(apart, 0.4175f, y);
    const auto cube = [](Float x) { return square(x) * x; };
    const Float mean = fma(-cube(square(seventh)), seventh, cube(square(sixth)));
    return fma(cosine, cube(square(y)), -mean);
  };
  return 0.5f * (of_half(reflection.low, steep.low) + of_half(reflection.high, steep.high));
}

/// Both halves of the light by two cosines each, a spread below and above their mean: what goes up
/// and down with the angle is not known by one. The root of the mean of y^k, y = 1 - cosine, is
/// m + (k - 1) s^2 / 2m to the second order of the spread s, and known of each half for k = 5.4
/// and, from the steep table, for 10. Of unequal roughness, of which that table knows nothing, s is
/// 0.
std::array<FacetReflection, 2> spread(Recorder& recorder, const FacetReflection& reflection,
                                      const FacetView& view) {
  const FacetReflection steep = for_dielectric(recorder, view, reflection, 1.0f);
  std::array<FacetReflection, 2> sides{reflection, reflection};
  const auto of_half = [&](Float FacetReflection::* half) {
    const Float y = 1.0f - reflection.*half;
    const Float apart = max(reflection.*half - steep.*half, 0.0f) * (1.0f - view.stretch);
    // At grazing both roots are nearly one number, of which tables know too little: no spread is
    // wider than that of all cosines from 0 to twice this one.
    const Float s2 = min((2.0f / 4.6f) * (y * apart), square(reflection.*half) * (1.0f / 3.0f));
    const Float mean = fma(s2, -2.2f / max(y, 0.05f), y);
    const Float s = sqrt(s2);
    sides[0].*half = saturate(1.0f - (mean + s));
    sides[1].*half = saturate(1.0f - (mean - s));
  };
  of_half(&FacetReflection::low), of_half(&FacetReflection::high);
  return sides;
}

/// The mean of f(cosine) over the reflected light; `film`: how much of it is a film's.
template <class F>
Color3 mean_over(Recorder& recorder, const FacetReflection& reflection, const FacetView& view,
                 Float film, F&& f) {
  if (film.is_constant(0.0f)) return reflection.mean(f);
  const Color3 two = if_any(film < 1.0f, Color3(0.0f), [&] { return reflection.mean(f); });
  return if_any(film > 0.0f, two, [&] {
    const auto [below, above] = spread(recorder, reflection, view);
    const Color3 four = Color3(0.5f) * (below.mean(f) + above.mean(f));
    return fma(four - two, Color3(film), two);
  });
}

}  // namespace

Color3 FacetFresnel::mean(Recorder& recorder, Accuracy accuracy, const FacetReflection& reflection,
                          const FacetView& view, Bool inside) const {
  const Color3 dip = this->dip();
  // Two cosines, half of the time, do for `fast`.
  const Float film = accuracy == Accuracy::fast ? Float(0.0f) : film_share();
  const auto of_cosines = [&](Bool from_inside) {
    const Color3 plain =
        mean_over(recorder, reflection, view, film, [&](Float c) { return at(c, from_inside); });
    if (is_zero(dip)) return plain;
    return saturate(fma(dip, Color3(excess_of_dip(recorder, reflection, view)), plain));
  };
  if (!has_inside()) return of_cosines(inside);
  const bool has_sum = !reflection.summed.is_constant(0.0f);
  const bool has_rest = !reflection.rest_share.is_constant(0.0f);
  // Of a dielectric whose mean is known the rest of a curve is smooth where light enters.
  const auto with_rest = [&](Float dielectric, Float eta, bool leaves) {
    if (is_dielectric()) return Color3(saturate(dielectric));
    const Bool from_inside = leaves ^ (index() < 1.0f);
    Color3 rest = mean_over(recorder, reflection, view, film, [&](Float c) {
      return at(c, from_inside) - Color3(fresnel_dielectric(c, eta));
    });
    if (leaves && has_rest) rest = fma(reflection.rest - rest, Color3(reflection.rest_share), rest);
    return saturate(Color3(dielectric) + rest);
  };
  // Where total reflection sets in no two cosines stand for all facets: a table has the mean.
  const auto leaving = [&] {
    const Float eta = min(index(), 1.0f / index());
    const Float table = facet_leaving(recorder, view, eta, reflection.albedo).fresnel;
    const Float dielectric =
        has_sum ? lerp(table, reflection.sum.fresnel, reflection.summed) : table;
    return with_rest(dielectric, eta, true);
  };
  const auto entering = [&] {
    // Of a known index what is known here as well: a number of the view's cosine alone.
    const Bool from_inside = index() < 1.0f;
    const Color3 two = of_cosines(from_inside);
    if (!has_sum || !covers_dielectric()) return two;
    return if_any(reflection.summed > 0.0f, two, [&] {
      const Color3 all = with_rest(reflection.sum.fresnel, max(index(), 1.0f / index()), false);
      // Two cosines may be far off, or no cosines at all, where the sum is all.
      const Color3 both = fma(all - two, Color3(reflection.summed), two);
      return select(reflection.summed < 1.0f, both, all);
    });
  };
  return choose(inside ^ (index() < 1.0f), leaving, entering);
}

Color3 prepare_tint(Recorder& recorder, Color3 tint) {
  return keep(recorder, min(max(tint, Color3(0.0f)), Color3(1e6f)));
}

ThinFilm prepare_film(NodeCall& call) {
  ThinFilm film(call.number("thinfilm_thickness"), call.number("thinfilm_ior"), call.accuracy());
  if (film.exists()) visit(film, [&](Float& x) { x = keep(call.recorder(), x); });
  return film;
}

Float grey(Color3 colour) {
  const bool one =
      same_value(colour.x.ref(), colour.y.ref()) && same_value(colour.x.ref(), colour.z.ref());
  return one ? colour.x : average(colour);
}

Float finite(Float x) { return min(max(x, 0.0f), largest_value); }

Bool is_unit(Float3 w) { return abs(dot(w, w) - 1.0f) < 1e-3f; }

}  // namespace nacre
