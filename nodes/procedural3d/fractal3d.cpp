#include "nodes/noise/fractal.h"
#include "nodes/noise/record_noise.h"

namespace nacre {

/// Octaves of Perlin noise of position, times amplitude: noise_i(p lacunarity^i)
/// diminish^i. MaterialX 1.39 Standard Nodes, "fractal3d". Two components are
/// fractals at position and at position + (19, 193, 17); a fourth is one at the
/// latter. No octaves give 0; those beyond 64 are left out. Coordinates as in
/// noise3d, those of all octaves; amplitudes up to 2^120. A diminish of NaN gives that.
void record_fractal3d(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const Octaves octaves(call);
  const auto one = [&](Float3 p) {
    return fractal<Float>(recorder, p, octaves, covered(call, p),
                          [&](Float3 q) { return perlin(recorder, q); });
  };
  const auto three = [&](Float3 p) {
    return fractal<Float3>(recorder, p, octaves, covered(call, p),
                           [&](Float3 q) { return perlin3(recorder, q); });
  };
  record_noise(call, call.vector3("position"), Float3(19.0f, 193.0f, 17.0f), true, 0.0f, one,
               three);
}

}  // namespace nacre
