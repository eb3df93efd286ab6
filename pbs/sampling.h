#pragma once

#include "runtime/value/vector.h"

namespace nacre {

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr float one_over_pi = 0.318309886183790671538f;

/// What cosines are taken to be larger by where a density goes by them: it shall not vanish where
/// light leaves along the surface that it is given for, since that need not be the one that there
/// is. An eighth costs a Lambertian 2 % of variance.
inline constexpr float least_cosine = 0.125f;

/// Cosine and sine of a share of the full circle, within 2.5e-7 in every mode, which is less than
/// from one share in [0.5, 1) to the next: less to do than cos() and sin(), to which angles may be
/// anything.
Float2 on_circle(Float share);

/// Uniform on the unit disk from two numbers in [0, 1).
Float2 sample_disk(Float u, Float v);

/// Cosine-weighted about +z; density z / pi. Local frame.
Float3 sample_cosine(Float u, Float v);

}  // namespace nacre
