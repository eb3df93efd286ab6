#include "nodes/noise/fractal.h"
#include "nodes/noise/record_noise.h"

namespace nacre {

/// Octaves of Perlin noise of texcoord, times amplitude: noise_i(p lacunarity^i)
/// diminish^i. MaterialX 1.39 Standard Nodes, "fractal2d". Two components are
/// fractals at texcoord and at texcoord + (19, 193); a fourth is one at the
/// latter. No octaves give 0; those beyond 64 are left out. Coordinates as in
/// noise2d, those of all octaves; amplitudes up to 2^120. A diminish of NaN gives that.
void record_fractal2d(NodeCall& call) {
  Recorder& recorder = call.recorder();
  const Octaves octaves(call);
  const auto one = [&](Float2 p) {
    return fractal<Float>(recorder, p, octaves, covered(call, p),
                          [&](Float2 q) { return perlin(recorder, q); });
  };
  const auto three = [&](Float2 p) {
    return fractal<Float3>(recorder, p, octaves, covered(call, p),
                           [&](Float2 q) { return perlin3(recorder, q); });
  };
  record_noise(call, call.vector2("texcoord"), Float2{19.0f, 193.0f}, true, 0.0f, one, three);
}

}  // namespace nacre
