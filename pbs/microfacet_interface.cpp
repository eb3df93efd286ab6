#include "pbs/microfacet_interface.h"

#include "pbs/facet_sum.h"
#include "pbs/tables/axes.h"

namespace nacre {

namespace {

/// The probability of reflection where `both` is that with both sides wanted.
Float reflection_probability(const View& view, Float both) {
  const auto [reflection, transmission] = view.wanted;
  return select(reflection, select(transmission, both, 1.0f), 0.0f);
}

}  // namespace

MicrofacetInterface::MicrofacetInterface(Recorder& recorder, const Facets& facets,
                                         const FacetFresnelPtr& fresnel,
                                         MicrofacetReflection::Options options)
    : facets_(facets),
      fresnel_(fresnel),
      options_(options),
      reflection_(facets, fresnel, options),
      transmission_(recorder, facets, fresnel->index(), options.tint, options.name),
      straight_(keep(recorder, goes_straight(fresnel->index()))) {}

LobePtr MicrofacetInterface::with_film(Recorder& recorder, const ThinFilm& film) const {
  return std::make_shared<MicrofacetInterface>(recorder, facets_, fresnel_->with_film(film),
                                               options_);
}

Bool MicrofacetInterface::separate(const View& view) const {
  return view.thin_walled | straight_ | facets_.delta;
}

Bool MicrofacetInterface::is_absent() const {
  if (!fresnel_->covers_dielectric()) return false;
  return straight_ & !(fresnel_->film_share() > 0.0f);
}

/// One over what the facets return in all. The tables know dielectrics; another
/// Fresnel factor moves light between what reflection and transmission return.
Color3 MicrofacetInterface::joint_factor(const View& view, const FacetReflection& perfect,
                                         Color3 fresnel) const {
  Recorder& recorder = *view.recorder;
  const LocalView local = facets_.look(view);
  const FacetView seen = facets_.table_view(local);
  // What a curve of more has more than the last dielectric of the tables is summed below.
  constexpr auto last = static_cast<float>(table_axes::last_index);
  const Float index = clamp(fresnel_->index(), 1.0f / last, last);
  const Float dense = max(index, 1.0f / index);
  const Float rare = min(index, 1.0f / index);
  FacetInterface both = choose(
      local.below ^ (index < 1.0f),
      [&] { return facet_leaving(recorder, seen, rare, perfect.albedo); },
      [&] {
        FacetInterface entering = facet_entering(recorder, seen, dense);
        entering.fresnel = perfect.mean([&](Float c) { return fresnel_dielectric(c, dense); });
        return entering;
      });
  // As in FacetFresnel::mean(), which it is taken from below.
  if (!perfect.summed.is_constant(0.0f)) {
    both.fresnel = lerp(both.fresnel, perfect.sum.fresnel, perfect.summed);
  }
  FacetSum light{.reflected = perfect.albedo, .passed = both.transmission, .total = both.total};
  const Float share = facet_sum_share(facets_.alpha, facets_.isotropic, dense);
  if (!share.is_constant(0.0f)) light = lerp(light, perfect.sum, share);
  const Float known = select(share > 0.0f, fresnel_->index(), index);
  const Float eta = relative_index(known, local.below);
  const auto inverse = [](Float total) { return 1.0f / max(total, 0.005f); };
  const Color3 bare(inverse(light.total));
  if (fresnel_->is_dielectric()) return bare;
  const Float film = fresnel_->film_share();
  const Bool is_other = fresnel_->covers_dielectric() ? film > 0.0f : Bool(true);
  return if_any(is_other, bare, [&] {
    const Color3 apart = fresnel - Color3(both.fresnel);
    Color3 more = product(apart, Color3(light.reflected - light.passed));
    // What a film does to the mean is not what it does to the facets that let light pass; nor is
    // what another curve does, where that is much.
    const Float alpha = max(facets_.alpha.x, facets_.alpha.y);
    Float rough = film.is_constant(0.0f) ? film : film * saturate(fma(100.0f, alpha, -1.0f));
    if (!fresnel_->covers_dielectric()) {
      const Float most = max(max_component(apart), max_component(-apart));
      // Bright curves have the mean of a dielectric's and another shape.
      const Float bright = saturate(fma(2.0f, dense, -3.6f));
      rough = max(rough, max(bright, saturate(fma(50.0f, most, -0.5f))));
    }
    const Float by_sum = facets_.isotropic ? rough : max(facet_stretch(facets_.alpha), rough);
    more = if_any(by_sum > 0.0f, more, [&] {
      const Color3 sum =
          sum_over_fresnel(recorder, view.accuracy, local.wo, facets_, *fresnel_, eta, local.below);
      return fma(sum - more, Color3(by_sum), more);
    });
    const Color3 total = Color3(light.total) + more;
    return Color3{inverse(total.x), inverse(total.y), inverse(total.z)};
  });
}

MicrofacetInterface::Terms MicrofacetInterface::compute(const View& from) const {
  View view = from;
  const bool is_scaled = view.compensation == Compensation::all;
  if (!is_scaled) view.compensation = Compensation::nothing;  // Of its reflection, too.
  const FacetReflection perfect = reflection_.facets(view, true);
  const Color3 fresnel = reflection_.mean_fresnel(view, perfect);
  const MicrofacetReflection::Terms reflection = reflection_.compute(view, perfect, fresnel);
  Color3 reflected = reflection.reflected;
  reflected = select(is_absent(), Color3(0.0f), reflected);
  const Color3 passing = Color3(1.0f) - reflected;
  const Float back = grey(reflected);
  const Float forth = grey(passing);
  const Float probability = select(back + forth > 0.0f, back / (back + forth), 1.0f);
  const Color3 factor = choose(
      is_scaled ? separate(view) : Bool(true), [] { return Color3(1.0f); },
      [&] { return joint_factor(view, perfect, fresnel); });
  return {factor, passing, probability, reflection};
}

std::optional<MicrofacetInterface::Terms> MicrofacetInterface::tabulated(const View& view) const {
  if (!facets_.delta.is_constant(false)) return std::nullopt;
  return table_.get(view, facets_, [&](const View& seen) {
    const MicrofacetInterface upright(*view.recorder, facets_.upright(), fresnel_, options_);
    return upright.compute(seen);
  });
}

MicrofacetInterface::Terms MicrofacetInterface::terms(const View& view) const {
  return terms_.get(view, [&] { return compute(view); });
}

void MicrofacetInterface::prepare(const View& view, Bool mask) const {
  facets_.look(view);  // At top level, so that lobes of one frame share it.
  transmission_.prepare(view, mask & separate(view));
  const std::optional<Terms> known = tabulated(view);
  terms_.prepare(view, mask, [&] {
    return from_table_or(view, facets_, known, [&] { return compute(view); });
  });
  reflection_.adopt(view, mask, terms(view).reflection);
}

Float3 MicrofacetInterface::turned(Float3 wi) const {
  const Bool back = options_.retroreflective & (wi.z > 0.0f);
  return {select(back, -wi.x, wi.x), select(back, -wi.y, wi.y), wi.z};
}

LobeValue MicrofacetInterface::evaluate(const View& view, Float3 wi) const {
  const Terms seen = terms(view);
  return choose(
      separate(view), [&] { return evaluate_separate(view, seen, wi); },
      [&] {
        return of_either(*view.recorder, facets_, [&](const Facets& facets) {
          return evaluate_joint(view, facets, seen, wi);
        });
      });
}

LobeValue MicrofacetInterface::evaluate_separate(const View& view, const Terms& terms,
                                                 Float3 wi) const {
  LobeValue back = reflection_.evaluate(view, wi);
  const LobeValue forth = transmission_.evaluate(view, wi);
  back.f = select(is_absent(), Color3(0.0f), back.f);
  const Float probability = reflection_probability(view, terms.probability);
  const Float pdf = fma(probability, back.pdf, (1.0f - probability) * forth.pdf);
  // A part too dark to be sampled is dark.
  return {.f = select(pdf > 0.0f, fma(terms.passing, forth.f, back.f), Color3(0.0f)), .pdf = pdf};
}

LobeValue MicrofacetInterface::evaluate_joint(const View& view, const Facets& facets,
                                              const Terms& terms, Float3 wi_world) const {
  const LocalView local = facets.look(view);
  FacetDirection wi = facets.direction(local, wi_world);
  if (!options_.retroreflective.is_constant(false)) {
    const Bool back = options_.retroreflective & (wi.z > 0.0f);
    wi.v = select(back, facets.turned(local, wi).v, wi.v);
  }
  const Float eta = relative_index(fresnel_->index(), local.below);
  const FacetEvent event = facet_between(local, facets.viewer(view, local), wi, eta, facets);
  const Bool reflects = wi.z > 0.0f;
  const Color3 fresnel = fresnel_->at(event.cosine, local.below);
  const Color3 share = select(reflects, fresnel, Color3(1.0f) - fresnel);
  const Float probability = reflection_probability(view, grey(fresnel));
  const Float scale = finite(event.pdf * event.shadowing);
  const Float pdf = event.pdf * select(reflects, probability, 1.0f - probability);
  const Bool seen = event.possible & (pdf > 0.0f);
  return {.f = options_.tint * share * terms.factor * Color3(select(seen, scale, 0.0f)),
          .pdf = select(seen, pdf, 0.0f)};
}

LobeSample MicrofacetInterface::sample(const View& view, Float3 u) const {
  const Terms seen = terms(view);
  return choose(
      separate(view), [&] { return sample_separate(view, seen, u); },
      [&] {
        return of_either(*view.recorder, facets_,
                         [&](const Facets& facets) { return sample_joint(view, facets, u); });
      });
}

LobeSample MicrofacetInterface::sample_separate(const View& view, const Terms& terms,
                                                Float3 u) const {
  const LobeSample back = reflection_.sample(view, u);
  const LobeSample forth = transmission_.sample(view, u);
  const Float reflection = reflection_probability(view, terms.probability);
  const Bool reflects = u.z < reflection;
  const Float probability = select(reflects, reflection, 1.0f - reflection);
  LobeSample sample{.wi = select(reflects, back.wi, forth.wi),
                    .valid = select(reflects, back.valid, forth.valid) & (probability > 0.0f),
                    .delta = select(reflects, back.delta, forth.delta)};
  if (!sample.delta.is_constant(false)) {
    const Color3 weight = select(reflects, back.delta_weight, terms.passing * forth.delta_weight);
    sample.delta_weight = weight * Color3(1.0f / max(probability, 1e-20f));
    sample.delta_probability = probability;
  }
  return sample;
}

LobeSample MicrofacetInterface::sample_joint(const View& view, const Facets& facets,
                                             Float3 u) const {
  const LocalView local = facets.look(view);
  const Float3 h = facets.sample_visible(local.wo, u.x, u.y);
  const Float cosine = saturate(dot(local.wo, h));
  const Float eta = relative_index(fresnel_->index(), local.below);
  const Refraction bent = refract(local.wo, h, cosine, eta);
  const Float3 mirrored = turned(reflect(local.wo, h));
  const Float fresnel = grey(fresnel_->at(cosine, local.below));
  const Bool reflects = u.z < reflection_probability(view, fresnel);
  const Float3 world = local.frame.to_world(select(reflects, mirrored, bent.wi));
  const Bool possible = select(reflects, mirrored.z > 0.0f, bent.possible);
  return {.wi = world, .valid = (local.wo.z > 0.0f) & possible};
}

Color3 MicrofacetInterface::albedo(const View&) const { return options_.tint; }

Color3 MicrofacetInterface::straight(const View& view) const {
  return product(terms(view).passing, transmission_.straight(view));
}

LobePtr microfacet_lobe(Recorder& recorder, std::string_view scatter_mode, const Facets& facets,
                        const FacetFresnelPtr& fresnel, MicrofacetReflection::Options options) {
  if (scatter_mode == "RT") {
    return std::make_shared<MicrofacetInterface>(recorder, facets, fresnel, options);
  }
  if (scatter_mode == "T") {
    return std::make_shared<MicrofacetTransmission>(recorder, facets, fresnel->index(),
                                                    options.tint, options.name);
  }
  return std::make_shared<MicrofacetReflection>(facets, fresnel, options);
}

}  // namespace nacre
