#include "pbs/microfacet_reflection.h"

#include "pbs/facet_sum.h"

namespace nacre {

FacetReflection MicrofacetReflection::facets(const View& view, bool transmits) const {
  const LocalView local = facets_.look(view);
  // What is not returned need not be known as well.
  if (view.compensation == Compensation::nothing) {
    return facet_reflection(*view.recorder, facets_.table_view(local));
  }
  const Bool inside = local.below & !view.thin_walled;
  return reflection_of_facets(*view.recorder, view.accuracy, facets_, local, *fresnel_, inside,
                              transmits);
}

Color3 MicrofacetReflection::mean_fresnel(const View& view, const FacetReflection& perfect) const {
  const LocalView local = facets_.look(view);
  const Bool inside = local.below & !view.thin_walled;
  return fresnel_->mean(*view.recorder, view.accuracy, perfect, facets_.table_view(local), inside);
}

MicrofacetReflection::Terms MicrofacetReflection::compute(const View& view,
                                                          const FacetReflection& perfect,
                                                          Color3 fresnel) const {
  const bool is_scaled = view.compensation != Compensation::nothing;
  const Color3 factor = is_scaled ? compensation(fresnel, perfect.albedo) : Color3(1.0f);
  // factor E as F (1 - E) + E, which is 1 for white: a base below white metal must not be seen.
  const Color3 albedo(perfect.albedo);
  const Color3 kept = is_scaled ? fma(fresnel, Color3(1.0f) - albedo, albedo) : albedo;
  const Color3 rough = saturate(fresnel * kept);
  return {factor, if_any(facets_.delta, rough, [&] { return mirror_fresnel(view); })};
}

/// What a mirror reflects.
Color3 MicrofacetReflection::mirror_fresnel(const View& view) const {
  const LocalView local = facets_.look(view);
  return fresnel_->at(local.wo.z, local.below & !view.thin_walled);
}

MicrofacetReflection::Terms MicrofacetReflection::compute(const View& view) const {
  const FacetReflection perfect = facets(view);
  return compute(view, perfect, mean_fresnel(view, perfect));
}

std::optional<MicrofacetReflection::Terms> MicrofacetReflection::tabulated(const View& view) const {
  if (!facets_.delta.is_constant(false)) return std::nullopt;
  return table_.get(view, facets_, [&](const View& seen) {
    const MicrofacetReflection upright(facets_.upright(), fresnel_, options_);
    return upright.compute(seen);
  });
}

MicrofacetReflection::Terms MicrofacetReflection::terms(const View& view) const {
  return terms_.get(view, [&] { return compute(view); });
}

LobePtr MicrofacetReflection::with_film(Recorder&, const ThinFilm& film) const {
  return std::make_shared<MicrofacetReflection>(facets_, fresnel_->with_film(film), options_);
}

void MicrofacetReflection::prepare(const View& view, Bool mask) const {
  facets_.look(view);  // At top level, so that lobes of one frame share it.
  const std::optional<Terms> known = tabulated(view);
  terms_.prepare(view, mask, [&] {
    return from_table_or(view, facets_, known, [&] { return compute(view); });
  });
}

void MicrofacetReflection::adopt(const View& view, Bool mask, const Terms& terms) const {
  terms_.prepare(view, mask, [&] { return terms; });
}

/// Directions as the facets see them, which lobes of one normal have in common.
struct MicrofacetReflection::Pair {
  FacetDirection wi;
  HalfVector half;
  Float cosine;  ///< Of either to the facet between them, in [0, 1].
};

MicrofacetReflection::Pair MicrofacetReflection::pair(const View& view, const Facets& facets,
                                                      const LocalView& local,
                                                      Float3 wi_world) const {
  FacetDirection wi = facets.direction(local, wi_world);
  // A lobe that is turned half round the normal sends light back.
  if (!options_.retroreflective.is_constant(false)) {
    wi.v = select(options_.retroreflective, facets.turned(local, wi).v, wi.v);
  }
  const HalfVector half = facets.between(local, facets.viewer(view, local), wi);
  return {wi, half, min(0.5f * sqrt(half.length2), 1.0f)};
}

void MicrofacetReflection::share_view(const View& view) const {
  const Float3 wo = facets_.look(view).wo;
  const Facets facets = facets_.likely(*view.recorder);
  (void)facets.root(wo);
  (void)facets.bound(wo);
}

void MicrofacetReflection::share_direction(const View& view, Float3 wi) const {
  (void)pair(view, facets_.likely(*view.recorder), facets_.look(view), wi);
}

LobeValue MicrofacetReflection::evaluate(const View& view, Float3 wi) const {
  const Terms terms = this->terms(view);
  return of_either(*view.recorder, facets_,
                   [&](const Facets& facets) { return evaluate(view, facets, terms, wi); });
}

LobeValue MicrofacetReflection::evaluate(const View& view, const Facets& facets, const Terms& terms,
                                         Float3 wi_world) const {
  const LocalView local = facets.look(view);
  const Float3 wo = local.wo;
  const auto [wi, half, cosine] = pair(view, facets, local, wi_world);
  const Float root = facets.root(wo);
  const Float half_d = facets.density(half, 0.5f);
  // Density and f over their common denominator: one division.
  const Float seen_from = max(fma(facets.bound(wo), wo.z, root), 1e-12f);
  const Float both = max(fma(wi.z, root, wo.z * facets.root(wi)), 1e-24f);
  const Float over = half_d / (seen_from * both);
  const Float pdf = over * both;
  // Below 1e-8 the half-way vector of two grazing directions is rounding.
  const Bool seen =
      (min(wo.z, wi.z) > 0.0f) & (half.length2 > 1e-8f) & (pdf > 0.0f) & !facets.delta;
  const Float f = over * seen_from * wi.z;
  const Bool inside = local.below & !view.thin_walled;
  const Color3 colour = options_.tint * fresnel_->at(cosine, inside) * terms.factor;
  // Of a density above 0 neither is NaN.
  return {.f = colour * Color3(select(seen, min(f, largest_value), 0.0f)),
          .pdf = select(seen, min(pdf, largest_value), 0.0f)};
}

namespace {

/// A direction in the frame of facets, where it is above them.
LobeSample sample_along(const LocalView& local, Float3 wi) {
  return {.wi = local.frame.to_world(wi), .valid = (local.wo.z > 0.0f) & (wi.z > 0.0f)};
}

}  // namespace

LobeSample sample_reflection(const Facets& all, const View& view, Float3 u, Bool back) {
  LobeSample sample = of_either(*view.recorder, all, [&](const Facets& facets) {
    const LocalView local = facets.look(view);
    const Float3 wo = local.wo;
    const Float3 h = facets.sample_reflecting(wo, u.x, u.y);
    const Float3 mirrored{-wo.x, -wo.y, wo.z};
    const Float3 wi = select(facets.delta, mirrored, reflect_about(wo, h));
    const Float3 sent{select(back, -wi.x, wi.x), select(back, -wi.y, wi.y), wi.z};
    return sample_along(local, sent);
  });
  sample.delta = all.delta;
  if (!all.delta.is_constant(false)) sample.delta_probability = 1.0f;
  return sample;
}

/// Not of light that is sent back.
const Facets* MicrofacetReflection::reflecting_facets() const {
  return options_.retroreflective.is_constant(false) ? &facets_ : nullptr;
}

Color3 MicrofacetReflection::mirrored(const View& view) const {
  return if_any(facets_.delta, Color3(0.0f), [&] { return options_.tint * mirror_fresnel(view); });
}

LobeSample MicrofacetReflection::sample(const View& view, Float3 u) const {
  LobeSample sample = sample_reflection(facets_, view, u, options_.retroreflective);
  sample.delta_weight = mirrored(view);
  return sample;
}

Color3 MicrofacetReflection::reflected(const View& view) const { return terms(view).reflected; }

Color3 MicrofacetReflection::albedo(const View& view) const {
  return options_.tint * reflected(view);
}

Color3 MicrofacetReflection::throughput(const View& view) const {
  if (options_.opaque) return Color3(0.0f);
  return Color3(1.0f) - reflected(view);
}

}  // namespace nacre
