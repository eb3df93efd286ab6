#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "pbs/facets.h"
#include "pbs/lobe.h"
#include "pbs/term.h"

namespace nacre {

/// Where a lobe was chosen, and what is left of the number that chose it: in [0, 1).
struct LobeChoice {
  Bool mine;
  Float again;
};

/// Of lobes that do nothing but reflect about facets of one frame, one is sampled: about the facets
/// of that which was chosen, wherever it is lobe `first` or one of the later ones. `mine` then
/// holds wherever it is, and `is_done` for each of the later ones. Nothing where `first` is no such
/// lobe or there is no other.
std::optional<Facets> common_facets(const std::vector<Term>& terms,
                                    const std::vector<LobeChoice>& choices, std::size_t first,
                                    Bool& mine, std::vector<bool>& is_done);

/// What such facets reflect a view to.
LobeSample sample_common(const Facets& facets, const std::vector<Term>& terms,
                         const std::vector<LobeChoice>& choices, const View& view, Float3 u);

}  // namespace nacre
