#pragma once

#include "runtime/program/recorder.h"
#include "runtime/value/vector.h"

namespace nacre {

/// Gradient noise: Perlin, "Improving Noise", 2002, over the lookup3 hash, as
/// Open Shading Language's "snoise" and the noise nodes of MaterialX define it.
/// Roughly in [-1, 1], 0 on the lattice. Coordinates beyond 2^23 have no fraction
/// left: 0 where all are beyond. Coordinates are finite: see within_reach. Recorded once per
/// Program and called.
Float perlin(Recorder& recorder, Float2 p);
Float perlin(Recorder& recorder, Float3 p);
/// Three noises at the cost of one hash: its three low bytes choose the gradients.
Float3 perlin3(Recorder& recorder, Float2 p);
Float3 perlin3(Recorder& recorder, Float3 p);

}  // namespace nacre
