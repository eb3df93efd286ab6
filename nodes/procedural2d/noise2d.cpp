#include "nodes/noise/fade.h"
#include "nodes/noise/perlin.h"
#include "nodes/noise/record_noise.h"

namespace nacre {

/// Perlin noise of texcoord, times amplitude plus pivot. MaterialX 1.39 Standard
/// Nodes, "noise2d". Two components are the first of three; a fourth is another
/// noise at texcoord + (19, 73). Coordinates end at 2^60, NaN at -2^60
/// (record_noise.h). Infinite amplitudes make NaN where the noise is 0.
void record_noise2d(NodeCall& call) {
  Recorder& recorder = call.recorder();
  record_noise(
      call, call.vector2("texcoord"), Float2{19.0f, 73.0f}, false, call.number("pivot"),
      [&](Float2 p) { return faded<Float>(covered(call, p), [&] { return perlin(recorder, p); }); },
      [&](Float2 p) {
        return faded<Float3>(covered(call, p), [&] { return perlin3(recorder, p); });
      });
}

}  // namespace nacre
