#include "pbs/wanted.h"

namespace nacre {

namespace {

constexpr std::int32_t reflections = lobe_diffuse_reflection | lobe_glossy_reflection;
constexpr std::int32_t transmissions = lobe_diffuse_transmission | lobe_glossy_transmission;

bool has_both_sides(const Lobe& lobe) {
  return (lobe.kinds() & reflections) != 0 && (lobe.kinds() & transmissions) != 0;
}

/// Whether wi is on the other side of what the lobe is shaded by.
Bool crosses(const Lobe& lobe, const View& view, Float3 wi) {
  const Float3 n = lobe.normal(view);
  return (dot(n, wi) < 0.0f) ^ (dot(n, view.wo) < 0.0f);
}

/// The bits of "lobes_wanted" that a lobe has on each side: glossy but where it is smooth.
struct Kinds {
  Int reflection, transmission;
};
Kinds kinds_of(const Lobe& lobe) {
  const std::int32_t kinds = lobe.kinds();
  const BySide smooth = lobe.smooth();
  const auto side = [&](std::int32_t diffuse, std::int32_t glossy, std::int32_t delta,
                        Bool is_smooth) {
    const Int rest(kinds & diffuse);
    if ((kinds & glossy) == 0) return rest;
    return rest | select(is_smooth, Int(delta), Int(glossy));
  };
  return {side(lobe_diffuse_reflection, lobe_glossy_reflection, lobe_delta_reflection,
               smooth.reflection),
          side(lobe_diffuse_transmission, lobe_glossy_transmission, lobe_delta_transmission,
               smooth.transmission)};
}

}  // namespace

std::vector<Term> wanted_terms(Recorder& recorder, std::vector<Term> terms) {
  const Int mask(recorder.input("lobes_wanted", Scalar::i32));
  Float total = 0.0f;
  for (Term& term : terms) {
    const Kinds kinds = kinds_of(*term.lobe);
    term.wanted = {(mask & kinds.reflection) != Int(0), (mask & kinds.transmission) != Int(0)};
    const Bool any = term.wanted.reflection | term.wanted.transmission;
    term.probability = select(any, term.probability, 0.0f);
    total = total + term.probability;
  }
  if (terms.size() == 1) return terms;
  const Float scale = select(total > 0.0f, 1.0f / total, 0.0f);
  for (Term& term : terms) term.probability = term.probability * scale;
  return terms;
}

View wanting(View view, const Term& term) {
  view.wanted = term.wanted;
  return view;
}

Bool is_wanted_side(const Term& term, const View& view, Float3 wi) {
  if (!has_both_sides(*term.lobe)) return true;
  return select(crosses(*term.lobe, view, wi), term.wanted.transmission, term.wanted.reflection);
}

LobeValue wanted_part(const Term& term, const View& view, Float3 wi, LobeValue value) {
  const Bool wanted = is_wanted_side(term, view, wi);
  return {select(wanted, value.f, Color3(0.0f)), select(wanted, value.pdf, 0.0f)};
}

Int kinds_along(const Term& term, const View& view, Float3 wi) {
  const Kinds kinds = kinds_of(*term.lobe);
  if (!has_both_sides(*term.lobe)) return kinds.reflection | kinds.transmission;
  return select(crosses(*term.lobe, view, wi), kinds.transmission, kinds.reflection);
}

}  // namespace nacre
