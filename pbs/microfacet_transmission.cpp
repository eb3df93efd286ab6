#include "pbs/microfacet_transmission.h"

namespace nacre {

namespace {

/// Seen from where next to nothing is refracted, what is is not scaled beyond this.
constexpr float least_transmission = 2e-3f;

Facets scaled(const Facets& facets, Float scale) {
  Facets thin = facets;
  const auto alpha = [&](Float x) { return clamp(x * scale, facets.threshold, 1.0f); };
  thin.alpha = {alpha(facets.alpha.x), alpha(facets.alpha.y)};
  return thin;
}

}  // namespace

FacetEvent facet_between(Float3 wo, Float3 wi, Float eta, Float2 alpha) {
  const Bool reflects = wi.z > 0.0f;
  const Float ratio = select(reflects, 1.0f, eta);
  const Float3 between = wo + wi * Float3(ratio);
  const Float length2 = dot(between, between);
  // 1 / length, with the sign that turns the facet to above.
  const Float scale = copysign(1.0f / sqrt(max(length2, 1e-8f)), between.z);
  const Float cos_o = dot(wo, between) * scale;
  const Float cos_i = dot(wi, between) * scale;
  const Float root_o = ggx_root(wo, alpha);
  const Float jacobian = square(ratio) * abs(cos_i) / max(length2, 1e-8f);
  const Float seen = 2.0f * ggx_distribution(between, alpha) * max(cos_o, 0.0f);
  const Bool other_side = reflects ^ (cos_i < 0.0f);
  return {
      .possible = (wo.z > 0.0f) & (wi.z != 0.0f) & (length2 > 1e-8f) & (cos_o > 0.0f) & other_side,
      .cosine = saturate(cos_o),
      .pdf = finite(seen * jacobian / max(wo.z + root_o, 1e-30f)),
      .shadowing = saturate(ggx_shadowing(wo.z, root_o, abs(wi.z), ggx_root(wi, alpha)))};
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
  const GgxView seen = facets_.table_view(local);
  const Float dense = max(index_, 1.0f / index_);
  const Float rare = min(index_, 1.0f / index_);
  const Bool leaving = local.below ^ (index_ < 1.0f);
  const Float passed = choose(
      leaving, [&] { return ggx_leaving(recorder, seen, rare, 1.0f).transmission; },
      [&] { return ggx_entering(recorder, seen, dense).transmission; });
  const Terms rough{1.0f / max(passed, least_transmission),
                    min(passed * Float(1.0f / least_transmission), 1.0f)};
  const Bool smooth = facets_.delta & !straight_;
  const Float cosine = local.wo.z;
  const Bool total = totally_reflected(cosine, relative_index(index_, local.below));
  return {rough.factor,
          select(straight_, 1.0f, select(smooth, to_float(!total), rough.transmitted))};
}

MicrofacetTransmission::Terms MicrofacetTransmission::thin(const View& view,
                                                           const LocalView& local) const {
  const GgxView seen = thin_facets_.table_view(local);
  return {1.0f / ggx_reflection(*view.recorder, seen).albedo, 1.0f};
}

MicrofacetTransmission::Terms MicrofacetTransmission::compute(const View& view) const {
  const LocalView local = facets_.look(view);
  return choose(
      view.thin_walled, [&] { return thin(view, local); }, [&] { return refracted(view, local); });
}

void MicrofacetTransmission::prepare(const View& view, Bool mask) const {
  facets_.look(view);
  terms_.prepare(view, mask, [&] { return compute(view); });
}

Bool MicrofacetTransmission::delta(const View&) const { return facets_.delta | straight_; }

LobeValue MicrofacetTransmission::evaluate(const View& view, Float3 wi_world) const {
  const Terms terms = terms_.get(view, [&] { return compute(view); });
  const LocalView local = facets_.look(view);
  const Float3 wi = local.frame.to_local(wi_world);
  const Bool crosses = wi.z < 0.0f;
  const FacetEvent event = choose(
      view.thin_walled,
      [&] { return facet_between(local.wo, {wi.x, wi.y, -wi.z}, 1.0f, thin_facets_.alpha); },
      [&] {
        return facet_between(local.wo, wi, relative_index(index_, local.below), facets_.alpha);
      });
  const Bool seen = crosses & event.possible & !delta(view);
  const Float f = finite(event.pdf * event.shadowing * terms.factor);
  return {.f = tint_ * Color3(select(seen, f, 0.0f)), .pdf = select(seen, event.pdf, 0.0f)};
}

LobeSample MicrofacetTransmission::sample(const View& view, Float3 u) const {
  const LocalView local = facets_.look(view);
  const Float3 wo = local.wo;
  const Refraction chosen = choose(
      view.thin_walled,
      [&] {
        const Float3 h = sample_visible_normal(wo, thin_facets_.alpha, u.x, u.y);
        const Float3 wi = reflect(wo, h);
        const Float3 through = select(delta(view), -wo, Float3(wi.x, wi.y, -wi.z));
        return Refraction{through, through.z < 0.0f};
      },
      [&] {
        const Float3 rough = sample_visible_normal(wo, facets_.alpha, u.x, u.y);
        const Float3 h = select(facets_.delta, Float3(0.0f, 0.0f, 1.0f), rough);
        const Float eta = relative_index(index_, local.below);
        const Refraction bent = refract(wo, h, saturate(dot(wo, h)), eta);
        return Refraction{select(straight_, -wo, bent.wi), straight_ | bent.possible};
      });
  const Float3 world = local.frame.to_world(chosen.wi);
  LobeSample sample{
      .wi = world, .valid = (wo.z > 0.0f) & chosen.possible & is_unit(world), .delta = delta(view)};
  if (!sample.delta.is_constant(false)) {
    sample.delta_weight = tint_;
    sample.delta_probability = 1.0f;
  }
  return sample;
}

Float MicrofacetTransmission::transmitted(const View& view) const {
  return terms_.get(view, [&] { return compute(view); }).transmitted;
}

Color3 MicrofacetTransmission::albedo(const View& view) const {
  return tint_ * Color3(transmitted(view));
}

}  // namespace nacre
