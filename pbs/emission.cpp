#include "pbs/emission.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "pbs/color_channels.h"
#include "pbs/facets.h"
#include "runtime/node/geometry.h"
#include "runtime/program/substitute.h"
#include "runtime/value/control.h"

namespace nacre {

namespace {

/// One of those that shine.
struct EmitterTerm {
  const Emitter* emitter;
  Float probability;  ///< With which directions are of it.
};

/// Each after all that it is part of: what is shared stands behind its last reader.
std::vector<const Edf*> from_whole_to_parts(const Edf& root) {
  std::vector<const Edf*> parts_first;
  std::unordered_map<const Edf*, bool> is_done;
  std::vector<const Edf*> open{&root};
  while (!open.empty()) {
    const Edf* at = open.back();
    const bool seen = is_done.contains(at);
    if (!seen) {
      is_done[at] = false;
      for (std::size_t i = 0; i < Edf::Parts::count; ++i) {
        const Edf* part = at->parts()[i].get();
        if (part != nullptr && !is_done.contains(part)) open.push_back(part);
      }
      continue;
    }
    open.pop_back();
    if (!is_done[at]) parts_first.push_back(at);
    is_done[at] = true;
  }
  std::ranges::reverse(parts_first);
  return parts_first;
}

/// What each that shines has of the power of all, by the largest channel.
std::vector<EmitterTerm> powers(const Edf& root) {
  std::unordered_map<const Edf*, Color3> seen{{&root, Color3(1.0f)}};
  std::vector<EmitterTerm> terms;
  for (const Edf* edf : from_whole_to_parts(root)) {
    const Color3 share = seen.at(edf);
    if (const Emitter* const emitter = edf->emitter()) {
      const Color3 power = power_seen(share, emitter->power());
      if (!is_zero(power)) terms.push_back({emitter, max_component(power)});
      continue;
    }
    for (std::size_t i = 0; i < Edf::Parts::count; ++i) {
      const Edf* part = edf->parts()[i].get();
      if (part == nullptr) continue;
      const Color3 of_part = edf->part_power(i, share);
      const auto [place, is_new] = seen.try_emplace(part, of_part);
      if (!is_new) place->second = min(place->second + of_part, Color3(1e20f));
    }
  }
  return terms;
}

/// Each at least a thousandth, as power is a guess of what is seen along a direction.
std::vector<EmitterTerm> emitter_terms(const Edf& root) {
  constexpr float least_share = 1e-3f;
  std::vector<EmitterTerm> terms = powers(root);
  if (terms.size() == 1) {
    terms[0].probability = select(terms[0].probability > 0.0f, Float(1.0f), Float(0.0f));
    return terms;
  }
  const auto scale = [&] {
    Float total = 0.0f;
    for (const EmitterTerm& term : terms) total = total + term.probability;
    return select(total > 0.0f, 1.0f / total, 0.0f);
  };
  const Float of_power = scale();
  for (EmitterTerm& term : terms) {
    const Float share = max(term.probability * of_power, least_share);
    term.probability = select(term.probability > 0.0f, share, 0.0f);
  }
  const Float of_share = scale();
  for (EmitterTerm& term : terms) term.probability = term.probability * of_share;
  return terms;
}

Float density(const std::vector<EmitterTerm>& terms, const View& view) {
  Float pdf = 0.0f;
  for (const EmitterTerm& term : terms) {
    pdf = fma(term.probability, term.emitter->pdf(view), pdf);
  }
  return pdf;
}

/// Unit up to rounding; zeros where nothing shines.
Float3 sample(const std::vector<EmitterTerm>& terms, const View& view, Float3 u) {
  Float3 chosen = Float3(0.0f);
  Float below = 0.0f;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const EmitterTerm& term = terms[i];
    const Float above = i + 1 == terms.size() ? Float(2.0f) : below + term.probability;
    const Bool mine = (u.z >= below) & (u.z < above) & (term.probability > 0.0f);
    // The number that chose the emitter is uniform again within its interval.
    const Float again =
        terms.size() == 1 ? u.z : clamp((u.z - below) / term.probability, 0.0f, 0x1.fffffep-1f);
    chosen = if_any(mine, chosen, [&] { return term.emitter->sample(view, {u.x, u.y, again}); });
    below = below + term.probability;
  }
  return chosen;
}

/// The channel of that name and component, for three numbers.
std::optional<Ref> component(std::string_view channel, std::string_view group, Float3 v) {
  if (channel.size() != group.size() + 2 || !channel.starts_with(group)) return std::nullopt;
  if (channel.ends_with(".x")) return v.x.ref();
  if (channel.ends_with(".y")) return v.y.ref();
  return channel.ends_with(".z") ? std::optional(v.z.ref()) : std::nullopt;
}

Float3 vector_of(std::span<const Ref> refs) {
  return {Float(refs[0]), Float(refs[1]), Float(refs[2])};
}

}  // namespace

SampledEmission sampled_emission(const EdfPtr& edf, const View& view, Color3 radiance) {
  if (edf == nullptr || is_zero(radiance)) return {};
  Recorder& recorder = *view.recorder;
  const std::vector<EmitterTerm> terms = emitter_terms(*edf);
  if (terms.empty()) return {};
  const Float3 ng = geometric_normal(recorder);
  const auto with = [&](std::string_view group, Float3 v, std::vector<Ref> values) {
    return substitute(recorder, values,
                      [&](std::string_view channel) { return component(channel, group, v); });
  };

  // The direction as a channel that no kernel reads: patterns may look along wo themselves.
  View along = view;
  along.wo = channel3(recorder, "emitted");
  const Float3 u = min(max(channel3(recorder, "u"), Color3(0.0f)), Float3(0x1.fffffep-1f));
  const Float3 drawn = sample(terms, along, u);
  const std::vector<Ref> of_point =
      with("wo", ng, {density(terms, along).ref(), drawn.x.ref(), drawn.y.ref(), drawn.z.ref()});
  const Float3 given = vector_of(std::span(of_point).subspan(1));
  // A step of Newton's: emitters give unit vectors up to the errors of frames and of fast sines.
  const Float3 near_unit = given * Float3(fma(-0.5f, dot(given, given), 1.5f));
  const Bool is_there = is_unit(near_unit);
  const Float3 w = select(is_there, near_unit, Float3(0.0f, 0.0f, 1.0f));

  const Float pdf(with("emitted", w, {of_point[0]})[0]);
  const Color3 light =
      vector_of(with("wo", w, {radiance.x.ref(), radiance.y.ref(), radiance.z.ref()}));
  const Bool valid = is_there & (pdf > 0.0f);
  const Color3 weight = finite_light(light * Float3(abs(dot(ng, w)) / pdf));
  SampledEmission result;
  add_color(result.emit, "emitted", w);
  add_color(result.emit, "weight", select(valid, weight, Color3(0.0f)));
  result.emit.push_back({"pdf", select(valid, pdf, 0.0f).ref()});
  const Float of_wo(with("emitted", view.wo, {of_point[0]})[0]);
  result.pdf = select(is_unit(view.wo), of_wo, 0.0f);
  return result;
}

}  // namespace nacre
