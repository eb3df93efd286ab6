#pragma once

#include "pbs/lobe.h"
#include "pbs/view.h"

namespace nacre {

/// By what a lobe's f is multiplied for what a path carries from wi to wo: by the channel
/// "transport", radiance (0), of paths from the eye, or importance (else), of paths from lights,
/// which arrive along wo. Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation":
///
///   radiance    the squared index on wo's side over that on wi's, where light is bent (5.2)
///   importance  |wo.Ns| |wi.Ng| / (|wo.Ng| |wi.Ns|), for shading is by another normal than the
///               surface's (5.19); the denominator is at least 1e-6
///
/// 1 of fibres, which have no normal, and of a host's lobes what they need of it is theirs to say:
/// they have a normal, and no index.
Float transport_factor(const Lobe& lobe, const View& view, Float3 wi);

}  // namespace nacre
