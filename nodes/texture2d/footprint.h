#pragma once

#include "nodes/texture2d/mip_level.h"
#include "runtime/value/vector.h"

namespace nacre {

/// How the texels under a point's footprint are read: `probes` look-ups on the levels
/// `level` and the next, along a line through the point. runtime/texture/sampling.h.
struct Probes {
  Float level;   ///< A whole number, 0 .. last.
  Float blend;   ///< Of the next level, in [0, 1); 0 on the last.
  Float count;   ///< A whole number, at least 1.
  Float2 reach;  ///< In uv, from the point to the ends of the line.
  Float spread;  ///< Weights are exp(-2 (spread p)^2) at p in [-1, 1] of the line.
};

template <class F>
void visit(Probes& p, F&& f) {
  f(p.level), f(p.blend), f(p.count), visit(p.reach, f), f(p.spread);
}

/// Of a footprint with the axes dx, dy (uv per pixel; NaN counts as no footprint), on an
/// image of that finest level, whose last level is number `last`. `max_anisotropy`: whole, at
/// least 1.
Probes find_probes(Float2 dx, Float2 dy, const MipLevel& finest, Float last, Float max_anisotropy);

/// The point is read once, on level 0.
Bool is_magnified(const Probes& probes);

/// Where probe number i lies: p in [-1, 1] of the line.
Float probe_position(const Probes& probes, Float i);
/// Its weight, not normalised.
Float probe_weight(const Probes& probes, Float p);

}  // namespace nacre
