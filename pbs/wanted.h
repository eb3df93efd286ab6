#pragma once

#include <vector>

#include "pbs/term.h"
#include "pbs/view.h"

namespace nacre {

/// The lobes that a host wants at a point; see KernelRequest::lobes_wanted.

/// The terms as if what is not wanted were not there: probabilities are of those that are, and 0 of
/// the others. Reads the channel "lobes_wanted".
std::vector<Term> wanted_terms(Recorder& recorder, std::vector<Term> terms);

/// The view with what is wanted of that term.
View wanting(View view, const Term& term);

/// Whether what the term sends along wi is wanted; of a lobe on one side of the surface it is.
Bool is_wanted_side(const Term& term, const View& view, Float3 wi);

/// The value where it is wanted, 0 elsewhere.
LobeValue wanted_part(const Term& term, const View& view, Float3 wi, LobeValue value);

/// As what the term scatters along wi: bits of "lobes_wanted".
Int kinds_along(const Term& term, const View& view, Float3 wi);

}  // namespace nacre
