#include "pbs/kernels.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>

#include "pbs/color_channels.h"
#include "pbs/common_facets.h"
#include "pbs/emission.h"
#include "pbs/enclosed.h"
#include "pbs/sampling.h"
#include "pbs/term.h"
#include "pbs/transport.h"
#include "pbs/wanted.h"
#include "runtime/node/geometry.h"
#include "runtime/program/origin.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

/// A pair of directions evaluated over all lobes.
struct Total {
  Color3 f = Color3(0.0f);
  Float pdf = 0.0f;
  std::vector<Color3> by_lobe;  ///< Their parts of f.
  Int kinds = 0;                ///< Of those that gave some of f; where lobes are wanted.
};

class SurfaceRecorder {
 public:
  SurfaceRecorder(Recorder& recorder, const Surface& surface, Accuracy accuracy,
                  const KernelRequest& request, const std::function<bool()>& may_go_on)
      : recorder_(recorder), surface_(surface), request_(request), ask_(may_go_on) {
    view_ = {.recorder = &recorder,
             .accuracy = accuracy,
             .wo = view_direction(recorder),
             .thin_walled = surface.thin_walled,
             .compensation = request.compensation,
             .table_error = request.table_error,
             .follows_subsurface = wants(entry_subsurface),
             .left_out = &left_out_,
             .media = wants(entry_interior) ? &media_ : nullptr,
             .unseen = &unseen_};
  }

  SurfaceKernels run() {
    terms_ = select_lobes(view_, true);
    view_.left_out = view_.unseen = nullptr;
    view_.media = nullptr;
    kernels_.not_modelled = left_out_.lines();
    // After what select_lobes() has put there.
    for (const LeftOut* lines : {&left_out_, &unseen_}) {
      kernels_.manifest.insert(kernels_.manifest.end(), lines->lines().begin(),
                               lines->lines().end());
    }
    for (const Term& term : terms_) {
      kernels_.lobes.push_back({std::string(term.lobe->name()),
                                recorder_.program().origins[term.origin], term.lobe->kinds()});
    }
    if (terms_.empty()) {
      kernels_.manifest.push_back("evaluate, sample, albedo: no lobe has a weight");
    } else {
      scattering_ = request_.lobes_wanted ? wanted_terms(recorder_, terms_) : terms_;
      if (wants(entry_evaluate | entry_evaluate_at | entry_shade)) record_evaluate();
      if (wants(entry_sample | entry_shade)) record_sample();
      if (wants(entry_albedo)) add_color(kernels_.albedo, "albedo", albedo());
    }
    if (wants(entry_emission | entry_emit)) record_emission();
    if (wants(entry_opacity)) record_opacity();
    if (wants(entry_interior)) kernels_.interior = interior_channels(view_, terms_, media_);
    if (wants(entry_subsurface)) kernels_.subsurface = subsurface_channels(view_, terms_);
    if (wants(entry_shadow)) record_shadow();
    record_point();
    return std::move(kernels_);
  }

 private:
  bool wants(std::uint32_t entries) const { return (request_.entries & entries) != 0; }

  bool may_go_on() {
    kernels_.complete = kernels_.complete && (!ask_ || ask_());
    return kernels_.complete;
  }

  /// The lobes seen from `view`, with weights and probabilities. For the real
  /// view direction they are kept, and what is left out goes to the manifest.
  std::vector<Term> select_lobes(const View& view, bool from_viewer) {
    const ScopedOrigin origin(recorder_, "layering");
    const std::vector<WeightedLobe> lobes =
        flatten(surface_.bsdf, view, [this] { return may_go_on(); });
    const Color3 share = conserving_share(view, lobes);
    const bool is_alone = std::ranges::count_if(lobes, [this](const WeightedLobe& each) {
                            return (each.lobe->kinds() & request_.lobes) != 0;
                          }) == 1;
    std::vector<Term> terms;
    Float total = 0.0f;
    for (const WeightedLobe& each : lobes) {
      if (!may_go_on()) break;
      if ((each.lobe->kinds() & request_.lobes) == 0) {
        if (from_viewer) note(*each.lobe, "of a kind that was not requested");
        continue;
      }
      if (from_viewer && is_darker(*each.lobe)) {
        note(*each.lobe, "without what several scatterings between facets bring back");
      }
      Term term{each.lobe, max(each.weight, Color3(0.0f)), Float(0.0f), each.origin, {}};
      if (request_.energy_conserving) term.weight = term.weight * share;
      const ScopedOrigin of_lobe(recorder_, each.origin);
      if (request_.lobe_mask) term.weight = masked(*each.lobe, term.weight);
      // What there is no choice of need not be weighed.
      const Color3 part = is_alone ? each.lobe->presence(view) : each.lobe->albedo(view);
      // A weight of NaN, which max() makes 0, must not silence the other lobes.
      term.probability = max(max_component(term.weight * part), 0.0f);
      total = total + term.probability;
      terms.push_back(std::move(term));
    }
    const Float scale = select(total > 0.0f, 1.0f / total, 0.0f);
    for (Term& term : terms) {
      term.probability = terms.size() == 1 ? select(total > 0.0f, Float(1.0f), Float(0.0f))
                                           : term.probability * scale;
      if (!from_viewer) continue;
      term.weight = keep(recorder_, term.weight);
      term.probability = keep(recorder_, term.probability);
    }
    return terms;
  }

  /// What of the light of these lobes leaves no more than arrives.
  Color3 conserving_share(const View& view, const std::vector<WeightedLobe>& lobes) {
    Color3 light = Color3(0.0f);
    if (!request_.energy_conserving) return Color3(1.0f);
    for (const WeightedLobe& each : lobes) {
      const ScopedOrigin of_lobe(recorder_, each.origin);
      light = fma(max(each.weight, Color3(0.0f)), each.lobe->light(view), light);
    }
    // Of a sum without bound nothing is left.
    return Color3(1.0f) / max(light, Color3(1.0f));
  }

  Color3 masked(const Lobe& lobe, Color3 weight) {
    const Int mask(recorder_.parameter("lobe_mask", Scalar::i32, lobe_all));
    return select((mask & Int(lobe.kinds())) == Int(0), Color3(0.0f), weight);
  }

  /// By what the request leaves out of its facets.
  bool is_darker(const Lobe& lobe) const {
    if (!lobe.is_of_facets() || request_.compensation == Compensation::all) return false;
    const bool transmits = (lobe.kinds() & lobe_glossy_transmission) != 0;
    return transmits || request_.compensation == Compensation::nothing;
  }

  void note(const Lobe& lobe, std::string_view reason) {
    kernels_.manifest.push_back(std::string(lobe.name()) + ": " + std::string(reason));
  }

  /// All lobes along (view.wo, wi).
  Total evaluate(const View& view, const std::vector<Term>& terms, Float3 wi) {
    Total total;
    for (const Term& term : terms) {
      const ScopedOrigin origin(recorder_, term.origin);
      term.lobe->share_direction(wanting(view, term), wi);
    }
    for (const Term& term : terms) {
      if (!may_go_on()) break;
      const ScopedOrigin origin(recorder_, term.origin);
      const LobeValue none{.f = Color3(0.0f), .pdf = 0.0f};
      LobeValue value = if_any(term.probability > 0.0f, none,
                               [&] { return term.lobe->evaluate(wanting(view, term), wi); });
      if (request_.lobes_wanted) value = wanted_part(term, view, wi, value);
      if (request_.transport) value.f = value.f * Color3(transport_factor(*term.lobe, view, wi));
      total.f = fma(term.weight, value.f, total.f);
      if (request_.by_lobe) total.by_lobe.push_back(term.weight * value.f);
      total.pdf = fma(term.probability, value.pdf, total.pdf);
      if (!request_.lobes_wanted) continue;
      const Bool gives = max_component(term.weight * value.f) > 0.0f;
      total.kinds = total.kinds | select(gives, kinds_along(term, view, wi), Int(0));
    }
    return total;
  }

  /// Light only where there is a density: what a lobe gives next to nothing of may have none left
  /// once it is multiplied by the lobe's probability.
  Total lit(Total total) const {
    if (scattering_.size() < 2) return total;
    const Bool is_there = total.pdf > 0.0f;
    total.f = select(is_there, total.f, Color3(0.0f));
    for (Color3& part : total.by_lobe) part = select(is_there, part, Color3(0.0f));
    if (request_.lobes_wanted) total.kinds = select(is_there, total.kinds, Int(0));
    return total;
  }

  /// The density of wo given wi: everything again, seen from wi.
  Float reverse_pdf(Float3 wi) {
    View reversed = view_;
    reversed.wo = wi;
    std::vector<Term> terms = select_lobes(reversed, false);
    if (request_.lobes_wanted) terms = wanted_terms(recorder_, std::move(terms));
    return evaluate(reversed, terms, view_.wo).pdf;
  }

  void share_view() {
    for (const Term& term : scattering_) {
      const ScopedOrigin origin(recorder_, term.origin);
      term.lobe->share_view(wanting(view_, term));
    }
  }

  void record_evaluate() {
    share_view();
    const Float3 wi = channel3(recorder_, "wi");
    const Total total = lit(evaluate(view_, scattering_, wi));
    add_color(kernels_.evaluate, "f", total.f);
    kernels_.evaluate.push_back({"pdf", total.pdf.ref()});
    if (request_.lobes_wanted) kernels_.evaluate.push_back({"kinds", total.kinds.ref()});
    for (std::size_t i = 0; i < total.by_lobe.size(); ++i) {
      add_color(kernels_.evaluate, "f.lobe" + std::to_string(i), total.by_lobe[i]);
    }
    if (request_.reverse_pdf) {
      kernels_.evaluate.push_back({"pdf_reverse", reverse_pdf(wi).ref()});
    }
  }

  void record_sample() {
    const ScopedOrigin origin(recorder_, "sampling");
    const Float3 u = channel3(recorder_, "u");
    // Once for all lobes: what is recorded for one of them is not seen by the others.
    (void)on_circle(u.y);
    share_view();
    Int lobe = -1;
    Color3 weight = Color3(1.0f);
    Float probability = 1.0f;
    Float below = 0.0f;
    std::vector<LobeChoice> choices;
    for (std::size_t i = 0; i < scattering_.size(); ++i) {
      const Term& term = scattering_[i];
      const ScopedOrigin of_lobe(recorder_, term.origin);
      const bool is_first = i == 0, is_last = i + 1 == scattering_.size();
      const Float above = below + term.probability;
      // Between its bounds there is a number only where it is probable; the last one's upper bound
      // is 1 but for rounding.
      Bool mine = is_last ? term.probability > 0.0f : u.z < above;
      if (!is_first || !is_last) mine = (u.z >= below) & mine;
      // The number that chose the lobe is uniform again within its interval.
      const Float again = is_first && is_last
                              ? u.z
                              : min(max((u.z - below) / term.probability, 0.0f), 0x1.fffffep-1f);
      choices.push_back({mine, again});
      lobe = select(mine, Int(static_cast<int>(i)), lobe);
      weight = select(mine, term.weight, weight);
      probability = select(mine, term.probability, probability);
      below = above;
    }
    finish_sample(sample_chosen(u, choices), lobe, weight, probability);
  }

  LobeSample sample_chosen(Float3 u, const std::vector<LobeChoice>& choices) {
    LobeSample chosen{.wi = Float3(0.0f, 0.0f, 1.0f), .valid = false};
    std::vector<bool> is_done(choices.size(), false);
    for (std::size_t i = 0; i < choices.size() && may_go_on(); ++i) {
      if (is_done[i]) continue;
      const Term& term = scattering_[i];
      const ScopedOrigin of_lobe(recorder_, term.origin);
      Bool mine = choices[i].mine;
      const std::optional<Facets> facets =
          request_.lobes_wanted ? std::nullopt
                                : common_facets(scattering_, choices, i, mine, is_done);
      chosen = if_any(mine, chosen, [&] {
        if (facets) return sample_common(*facets, scattering_, choices, view_, u);
        LobeSample sample = term.lobe->sample(wanting(view_, term), {u.x, u.y, choices[i].again});
        if (request_.lobes_wanted) {
          sample.valid = sample.valid & is_wanted_side(term, view_, sample.wi);
        }
        return sample;
      });
    }
    return chosen;
  }

  void finish_sample(const LobeSample& chosen, Int lobe, Color3 weight, Float probability) {
    // A step of Newton's: lobes give unit vectors up to the errors of frames and of fast sines.
    const Float3 wi = chosen.wi * Float3(fma(-0.5f, dot(chosen.wi, chosen.wi), 1.5f));
    const Bool found = chosen.valid & (is_unit(chosen.wi) | is_checked(lobe));
    const Total total = evaluate(view_, scattering_, wi);
    const Bool smooth = found & !chosen.delta & (total.pdf > 0.0f);
    const Float chance = chosen.delta_probability * probability;
    const Bool delta = found & chosen.delta & (chance > 0.0f);
    const Bool valid = smooth | delta;
    const Float inverse = 1.0f / total.pdf;
    const std::optional<Color3> alone = weight_alone(wi);
    const auto weight_of = [&](Color3 f) { return alone.value_or(f * Color3(inverse)); };
    const Color3 ratio = select(smooth, weight_of(total.f), Color3(0.0f));
    Color3 discrete = chosen.delta_weight * weight * Color3(1.0f / probability);
    if (request_.transport) discrete = discrete * Color3(delta_transport(lobe, wi));
    const Color3 out = select(delta, discrete, ratio);
    const Float pdf = select(delta, chance, select(smooth, total.pdf, 0.0f));
    const Float3 ng = geometric_normal(recorder_);
    const Bool crosses = (dot(ng, wi) < 0.0f) ^ (dot(ng, view_.wo) < 0.0f);
    const Int flags = select(valid, Int(sample_valid), Int(0)) |
                      select(delta, Int(sample_delta), Int(0)) |
                      select(valid & crosses, Int(sample_transmission), Int(0)) |
                      select(delta & goes_below(lobe), Int(sample_subsurface), Int(0));
    kernels_.sample = {
        {"wi.x", wi.x.ref()},      {"wi.y", wi.y.ref()},      {"wi.z", wi.z.ref()},
        {"weight.x", out.x.ref()}, {"weight.y", out.y.ref()}, {"weight.z", out.z.ref()},
        {"pdf", pdf.ref()},        {"lobe", lobe.ref()},      {"flags", flags.ref()}};
    if (request_.reverse_pdf) {
      const Float reverse = select(delta, pdf, select(smooth, reverse_pdf(wi), Float(0.0f)));
      kernels_.sample.push_back({"pdf_reverse", reverse.ref()});
    }
    if (request_.lobes_wanted) {
      Int kinds = 0;
      for (std::size_t i = 0; i < scattering_.size(); ++i) {
        const Bool mine = valid & (lobe == Int(static_cast<int>(i)));
        kinds = select(mine, kinds_along(scattering_[i], view_, wi), kinds);
      }
      kernels_.sample.push_back({"kinds", kinds.ref()});
    }
    if (request_.min_alpha) {
      const Float alpha = select(valid, alpha_of(lobe), 0.0f);
      kernels_.sample.push_back({"alpha", alpha.ref()});
    }
    for (std::size_t i = 0; i < total.by_lobe.size(); ++i) {
      const Bool mine = delta & (lobe == Int(static_cast<int>(i)));
      const Color3 part =
          select(smooth, weight_of(total.by_lobe[i]), select(mine, discrete, Color3(0.0f)));
      add_color(kernels_.sample, "weight.lobe" + std::to_string(i), part);
    }
  }

  /// Of a sample of a lobe that is alone, whole and says so: it is always chosen.
  std::optional<Color3> weight_alone(Float3 wi) const {
    if (scattering_.size() != 1 || request_.transport) return std::nullopt;
    const Term& term = scattering_.front();
    const ScopedOrigin origin(recorder_, term.origin);
    const bool is_whole = term.weight.x.is_constant(1.0f) && term.weight.y.is_constant(1.0f) &&
                          term.weight.z.is_constant(1.0f);
    if (!is_whole) return std::nullopt;
    return term.lobe->share(wanting(view_, term), wi);
  }

  /// The mean alpha of that lobe's facets; 0 where it has none.
  Float alpha_of(Int lobe) const {
    Float alpha = 0.0f;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (!terms_[i].lobe->is_of_facets()) continue;
      const Float root = terms_[i].lobe->roughness(view_);
      alpha = select(lobe == Int(static_cast<int>(i)), root * root, alpha);
    }
    return alpha;
  }

  /// transport_factor of the lobe that a delta is of. What goes below is still on its way.
  Float delta_transport(Int lobe, Float3 wi) const {
    Float factor = 1.0f;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const Lobe& each = *terms_[i].lobe;
      if (each.goes_below() && view_.follows_subsurface) continue;
      factor = select(lobe == Int(static_cast<int>(i)), transport_factor(each, view_, wi), factor);
    }
    return factor;
  }

  /// Whether that lobe has looked at its samples.
  Bool is_checked(Int lobe) const {
    Bool result = false;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (terms_[i].lobe->checks_samples()) result = result | (lobe == Int(static_cast<int>(i)));
    }
    return result;
  }

  /// Whether light of that lobe, where it is a delta, goes below the surface.
  Bool goes_below(Int lobe) const {
    Bool result = false;
    if (!view_.follows_subsurface) return result;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (terms_[i].lobe->goes_below()) result = result | (lobe == Int(static_cast<int>(i)));
    }
    return result;
  }

  Color3 albedo() {
    Color3 total = Color3(0.0f);
    for (const Term& term : terms_) {
      if (!may_go_on()) break;
      const ScopedOrigin origin(recorder_, term.origin);
      // Of all that they send back, though that may be more than arrives, the sum is what counts.
      total = fma(term.weight, term.lobe->light(view_), total);
    }
    return saturate(total);
  }

  Color3 emission() const {
    const ScopedOrigin origin(recorder_, "emission");
    return radiance(surface_.edf, view_);
  }

  /// As denoisers like it: of what is seen, and of the shading normal where nothing is.
  Float3 mean_normal() const {
    const Float3 shading = facing(normal(recorder_, Space::world), view_.wo);
    Float3 sum = Float3(0.0f);
    for (const Term& term : terms_) {
      const Float3 n = facing(term.lobe->normal(view_), view_.wo);
      sum = fma(Float3(term.probability), n, sum);
    }
    const Float squared = dot(sum, sum);
    return select(squared > 1e-6f, sum * Float3(1.0f / sqrt(squared)), shading);
  }

  Float mean_roughness() const {
    Float sum = 0.0f;
    for (const Term& term : terms_) {
      sum = fma(term.probability, term.lobe->roughness(view_), sum);
    }
    // Probabilities are 1 together up to rounding.
    return terms_.size() > 1 ? min(sum, 1.0f) : sum;
  }

  void record_point() {
    const std::set<std::string> names(request_.with_begin.begin(), request_.with_begin.end());
    for (const std::string& name : names) {
      if (name == "albedo") add_color(kernels_.point, name, albedo());
      if (name == "emission") add_color(kernels_.point, name, emission());
      if (name == "normal") add_color(kernels_.point, name, mean_normal());
      if (name == "roughness") kernels_.point.push_back({name, mean_roughness().ref()});
      if (name != "opacity") continue;
      kernels_.point.push_back({name, surface_.opacity.ref()});
      add_color(kernels_.point, "transmission", surface_.transmission);
    }
  }

  void record_emission() {
    const Color3 emitted = emission();
    if (is_zero(emitted)) {
      kernels_.manifest.push_back("emission: always black");
      return;
    }
    if (wants(entry_emission)) add_color(kernels_.emission, "emission", emitted);
    if (!wants(entry_emit)) return;
    const ScopedOrigin origin(recorder_, "emission");
    SampledEmission sampled = sampled_emission(surface_.edf, view_, emitted);
    kernels_.emit = std::move(sampled.emit);
    if (wants(entry_emission)) kernels_.emission.push_back({"pdf", sampled.pdf.ref()});
  }

  void record_shadow() {
    const ScopedOrigin origin(recorder_, "shadow");
    Color3 straight = surface_.transmission;
    for (const Term& term : terms_) {
      const Color3 part = product(term.weight, term.lobe->straight(view_));
      if (!is_zero(part)) straight = is_zero(straight) ? part : straight + part;
    }
    if (surface_.opacity.is_constant(1.0f) && is_zero(straight)) {
      kernels_.manifest.push_back("shadow: always opaque");
      return;
    }
    kernels_.shadow = {{"presence", surface_.opacity.ref()}};
    add_color(kernels_.shadow, "opacity_color", Color3(1.0f) - saturate(straight));
  }

  void record_opacity() {
    if (surface_.opacity.is_constant(1.0f) && is_zero(surface_.transmission)) {
      kernels_.manifest.push_back("opacity: always opaque");
      return;
    }
    kernels_.opacity = {{"opacity", surface_.opacity.ref()}};
    add_color(kernels_.opacity, "transmission", surface_.transmission);
  }

  Recorder& recorder_;
  const Surface& surface_;
  const KernelRequest& request_;
  const std::function<bool()>& ask_;
  std::vector<SeenMedium> media_;
  LeftOut left_out_;
  LeftOut unseen_;
  View view_;
  std::vector<Term> terms_;
  std::vector<Term> scattering_;  ///< The same as `evaluate` and `sample` use them.
  SurfaceKernels kernels_;
};

}  // namespace

bool is_point_result(std::string_view name) {
  constexpr std::string_view names[] = {"albedo", "emission", "normal", "opacity", "roughness"};
  return std::ranges::find(names, name) != std::end(names);
}

SurfaceKernels record_kernels(Recorder& recorder, const Surface& surface, Accuracy accuracy,
                              const KernelRequest& request,
                              const std::function<bool()>& may_go_on) {
  return SurfaceRecorder(recorder, surface, accuracy, request, may_go_on).run();
}

}  // namespace nacre
