#include "pbs/microfacet_transmission.h"

#include "pbs/facet_sum.h"

namespace nacre {

namespace {

/// Where less than this part of the light passes, facets that reflect all come in; times
/// 1 - alpha, because some light always passes the roughest surfaces, but at grazing little.
constexpr float little = 0.2f;
constexpr float least = 0.05f;

Facets scaled(const Facets& facets, Float scale) {
  Facets thin = facets;
  const auto alpha = [&](Float x) { return clamp(x * scale, facets.threshold, 1.0f); };
  thin.alpha = {alpha(facets.alpha.x), alpha(facets.alpha.y)};
  return thin;
}

}  // namespace

FacetEvent facet_between(const LocalView& local, const FacetDirection& wo, const FacetDirection& wi,
                         Float eta, const Facets& facets) {
  const Bool reflects = wi.z > 0.0f;
  const Float ratio = select(reflects, 1.0f, eta);
  const HalfVector between = facets.between(local, wo, wi, ratio);
  const Float length2 = between.length2;
  // 1 / length, with the sign that turns the facet to above.
  const Float scale = copysign(1.0f / sqrt(max(length2, 1e-8f)), between.h.z);
  const Float cos_o = dot(wo.v, between.h.v) * scale;
  const Float cos_i = dot(wi.v, between.h.v) * scale;
  const Float root_o = facets.root(wo);
  const Float jacobian = square(ratio) * abs(cos_i) * square(scale);
  const Float seen = facets.density(between, 2.0f) * max(cos_o, 0.0f);
  const Bool other_side = reflects ^ (cos_i < 0.0f);
  // Shadowing is smith_shadowing() over the same denominator as the density.
  const Float above_o = max(wo.z + root_o, 1e-12f);
  const Float above_i = abs(wi.z);
  const Float both = max(fma(above_i, root_o, wo.z * facets.root(wi)), 1e-24f);
  const Float inverse = 1.0f / (above_o * both);
  return {
      .possible = (wo.z > 0.0f) & (wi.z != 0.0f) & (length2 > 1e-8f) & (cos_o > 0.0f) & other_side,
      .cosine = saturate(cos_o),
      .pdf = finite(seen * jacobian * (both * inverse)),
      .shadowing = saturate(above_i * square(above_o) * inverse)};
}

Refraction refract(Float3 wo, Float3 h, Float cosine, Float eta) {
  const Float d = (eta - 1.0f) * (eta + 1.0f);
  const Float squared = fma(cosine, cosine, d);
  // cos - sqrt(cos^2 + d), its difference divided out.
  const Float along = -d / (cosine + safe_sqrt(squared));
  const Float inverse = 1.0f / eta;
  const Float3 wi{fma(along, h.x, -wo.x) * inverse, fma(along, h.y, -wo.y) * inverse,
                  fma(along, h.z, -wo.z) * inverse};
  return {wi, (squared > 0.0f) & (wi.z < 0.0f)};
}

MicrofacetTransmission::MicrofacetTransmission(Recorder& recorder, Facets facets, Float index,
                                               Color3 tint, std::string_view name)
    : facets_(std::move(facets)),
      index_(keep(recorder, index)),
      tint_(keep(recorder, tint)),
      straight_(keep(recorder, goes_straight(index))),
      name_(name) {
  const Float dense = max(index_, 1.0f / index_);
  thin_facets_ = scaled(facets_, saturate(fma(0.65f, dense, -0.35f)));
}

MicrofacetTransmission::Terms MicrofacetTransmission::refracted(const View& view,
                                                                const LocalView& local) const {
  Recorder& recorder = *view.recorder;
  const FacetView seen = facets_.table_view(local);
  const Float dense = max(index_, 1.0f / index_);
  const Float rare = min(index_, 1.0f / index_);
  const Bool leaving = local.below ^ (index_ < 1.0f);
  const auto perfect = [&] { return facet_reflection(recorder, seen).albedo; };
  FacetSum light = choose(
      leaving,
      [&] {
        const Float reflected = perfect();
        const FacetInterface all = facet_leaving(recorder, seen, rare, reflected);
        return FacetSum{.reflected = reflected,
                        .passed = all.transmission,
                        .total = all.total,
                        .turned = all.turned};
      },
      [&] {
        const FacetInterface all = facet_entering(recorder, seen, dense);
        return FacetSum{.passed = all.transmission, .total = all.total};
      });
  const Float share = facet_sum_share(facets_.alpha, facets_.isotropic, dense);
  light = if_any((share > 0.0f) & !delta(view), light, [&] {
    const Float eta = relative_index(index_, local.below);
    const Float reflected = if_any(eta < 1.0f, Float(1.0f), perfect);
    const FacetSum sum =
        sum_over_facets(recorder, view.accuracy, local.wo, facets_, eta, reflected, true);
    return lerp(light, sum, share);
  });
  const Float part = light.passed / max(light.total, 0.05f);
  const Float narrow = facets_.isotropic ? seen.alpha : min(facets_.alpha.x, facets_.alpha.y);
  const Float x = saturate(part / max(little * (1.0f - narrow), least));
  const Float turned = select(leaving, fma(square(x), fma(2.0f, x, -3.0f), 1.0f), 0.0f);
  return {1.0f / max(fma(turned, light.turned, light.passed), 0.005f), turned};
}

MicrofacetTransmission::Terms MicrofacetTransmission::thin(const View& view,
                                                           const LocalView& local) const {
  const FacetView seen = thin_facets_.table_view(local);
  return {1.0f / facet_reflection(*view.recorder, seen).albedo, 0.0f};
}

MicrofacetTransmission::Terms MicrofacetTransmission::compute(const View& view) const {
  if (view.compensation != Compensation::all) return {1.0f, 0.0f};
  const LocalView local = facets_.look(view);
  return choose(
      view.thin_walled, [&] { return thin(view, local); }, [&] { return refracted(view, local); });
}

void MicrofacetTransmission::prepare(const View& view, Bool mask) const {
  facets_.look(view);
  terms_.prepare(view, mask, [&] { return compute(view); });
}

void MicrofacetTransmission::share_view(const View& view) const {
  const Float3 wo = facets_.look(view).wo;
  const Recorder& recorder = *view.recorder;
  if (!view.thin_walled.is_constant(true)) (void)facets_.likely(recorder).root(wo);
  if (!view.thin_walled.is_constant(false)) (void)thin_facets_.likely(recorder).root(wo);
}

Bool MicrofacetTransmission::delta(const View&) const { return facets_.delta | straight_; }

LobeValue MicrofacetTransmission::evaluate(const View& view, Float3 wi_world) const {
  const Terms terms = terms_.get(view, [&] { return compute(view); });
  const LocalView local = facets_.look(view);
  const Bool crosses = dot(wi_world, local.frame.z) < 0.0f;
  const Float eta = relative_index(index_, local.below);
  const auto event_of = [&](const Facets& all, bool is_thin) {
    return of_either(*view.recorder, all, [&](const Facets& facets) {
      const FacetDirection wo = facets.viewer(view, local);
      const FacetDirection wi = facets.direction(local, wi_world);
      return is_thin ? facet_between(local, wo, facets.mirrored(local, wi), 1.0f, facets)
                     : facet_between(local, wo, wi, eta, facets);
    });
  };
  const FacetEvent event = choose(
      view.thin_walled, [&] { return event_of(thin_facets_, true); },
      [&] { return event_of(facets_, false); });
  const Bool turns = (!view.thin_walled) & totally_reflected(event.cosine, eta);
  const Float share = select(crosses, 1.0f, select(turns, terms.turned, 0.0f));
  const Bool seen = event.possible & !delta(view);
  const Float pdf = select(seen, event.pdf * share, 0.0f);
  return {.f = tint_ * Color3(finite(pdf * event.shadowing * terms.factor)), .pdf = pdf};
}

LobeSample MicrofacetTransmission::sample(const View& view, Float3 u) const {
  const Terms terms = terms_.get(view, [&] { return compute(view); });
  const auto along = [&](const LocalView& local, const Refraction& chosen) {
    return LobeSample{.wi = local.frame.to_world(chosen.wi),
                      .valid = (local.wo.z > 0.0f) & chosen.possible};
  };
  const auto through_wall = [&](const Facets& facets) {
    const LocalView local = facets.look(view);
    const Float3 wo = local.wo;
    const Float3 h = facets.sample_visible(wo, u.x, u.y);
    const Float3 wi = reflect(wo, h);
    const Float3 through = select(delta(view), -wo, Float3(wi.x, wi.y, -wi.z));
    return along(local, {through, through.z < 0.0f});
  };
  const auto bent_by = [&](const Facets& facets) {
    const LocalView local = facets.look(view);
    const Float3 wo = local.wo;
    const Float3 rough = facets.sample_visible(wo, u.x, u.y);
    const Float3 h = select(facets.delta, Float3(0.0f, 0.0f, 1.0f), rough);
    const Float eta = relative_index(index_, local.below);
    const Float cosine = saturate(dot(wo, h));
    const Refraction bent = refract(wo, h, cosine, eta);
    const Float3 back = reflect(wo, h);
    const Bool turns =
        totally_reflected(cosine, eta) & (back.z > 0.0f) & (facets.delta | (u.z < terms.turned));
    return along(local, {select(straight_, -wo, select(turns, back, bent.wi)),
                         straight_ | turns | bent.possible});
  };
  const Recorder& recorder = *view.recorder;
  LobeSample sample = choose(
      view.thin_walled, [&] { return of_either(recorder, thin_facets_, through_wall); },
      [&] { return of_either(recorder, facets_, bent_by); });
  sample.delta = delta(view);
  if (!sample.delta.is_constant(false)) {
    sample.delta_weight = tint_;
    sample.delta_probability = 1.0f;
  }
  return sample;
}

Color3 MicrofacetTransmission::albedo(const View&) const { return tint_; }

Color3 MicrofacetTransmission::straight(const View& view) const {
  return select(straight_ | (facets_.delta & view.thin_walled), tint_, Color3(0.0f));
}

}  // namespace nacre
