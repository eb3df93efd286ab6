#include "nodes/noise/fade.h"
#include "nodes/noise/perlin.h"
#include "nodes/noise/record_noise.h"

namespace nacre {

/// Perlin noise of position, times amplitude plus pivot. MaterialX 1.39 Standard
/// Nodes, "noise3d". Two components are the first of three; a fourth is another
/// noise at position + (19, 73, 29). Coordinates end at 2^60, NaN at -2^60
/// (record_noise.h). Infinite amplitudes make NaN where the noise is 0.
void record_noise3d(NodeCall& call) {
  Recorder& recorder = call.recorder();
  record_noise(
      call, call.vector3("position"), Float3(19.0f, 73.0f, 29.0f), false, call.number("pivot"),
      [&](Float3 p) { return faded<Float>(covered(call, p), [&] { return perlin(recorder, p); }); },
      [&](Float3 p) {
        return faded<Float3>(covered(call, p), [&] { return perlin3(recorder, p); });
      });
}

}  // namespace nacre
