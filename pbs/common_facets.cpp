#include "pbs/common_facets.h"

#include "pbs/microfacet_reflection.h"
#include "runtime/value/control.h"

namespace nacre {

std::optional<Facets> common_facets(const std::vector<Term>& terms,
                                    const std::vector<LobeChoice>& choices, std::size_t first,
                                    Bool& mine, std::vector<bool>& is_done) {
  const Facets* const own = terms[first].lobe->reflecting_facets();
  if (own == nullptr) return std::nullopt;
  Facets all = *own;
  bool has_other = false;
  for (std::size_t k = first + 1; k < choices.size(); ++k) {
    const Facets* const other = terms[k].lobe->reflecting_facets();
    if (other == nullptr || !have_one_frame(all, *other)) continue;
    const Float x = select(choices[k].mine, other->alpha.x, all.alpha.x);
    const Float y = all.isotropic ? x : select(choices[k].mine, other->alpha.y, all.alpha.y);
    all.alpha = {x, y};
    all.delta = select(choices[k].mine, other->delta, all.delta);
    mine = mine | choices[k].mine;
    is_done[k] = has_other = true;
  }
  return has_other ? std::optional(all) : std::nullopt;
}

LobeSample sample_common(const Facets& facets, const std::vector<Term>& terms,
                         const std::vector<LobeChoice>& choices, const View& view, Float3 u) {
  LobeSample sample = sample_reflection(facets, view, u);
  if (facets.delta.is_constant(false)) return sample;
  for (std::size_t k = 0; k < choices.size(); ++k) {
    const Lobe& lobe = *terms[k].lobe;
    const Facets* const own = lobe.reflecting_facets();
    if (own == nullptr || !have_one_frame(facets, *own)) continue;
    sample.delta_weight = if_any(choices[k].mine & own->delta, sample.delta_weight,
                                 [&] { return lobe.mirrored(view); });
  }
  return sample;
}

}  // namespace nacre
