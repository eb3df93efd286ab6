#pragma once

#include "runtime/value/vector.h"

namespace nacre {

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr float one_over_pi = 0.318309886183790671538f;

/// Uniform on the unit disk from two numbers in [0, 1).
Float2 sample_disk(Float u, Float v);

/// Cosine-weighted about +z; density z / pi. Local frame.
Float3 sample_cosine(Float u, Float v);

}  // namespace nacre
