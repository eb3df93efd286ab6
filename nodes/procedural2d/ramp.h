#pragma once

#include <string_view>

#include "runtime/node/componentwise.h"

namespace nacre {

/// (1 - t) a + t b for every component of the inputs named.
inline void record_ramp(NodeCall& call, std::string_view from, std::string_view to, Float t) {
  componentwise(call, ports(from, to), [t](Float a, Float b) { return lerp(a, b, t); });
}

/// 0 before the edge and 1 behind it, box-filtered over the footprint of the
/// shading point: linear over the widths (lengths of the footprint gradient) of
/// x and of the edge together. A step, 0 at the edge itself, where neither
/// varies.
inline Float filtered_step(Float edge, Float x) {
  const auto width = [](Float value) {
    const Float dx = footprint_derivative(value, 0);
    const Float dy = footprint_derivative(value, 1);
    return sqrt(fma(dx, dx, dy * dy));
  };
  const Float whole = width(edge) + width(x);
  const Float start = fma(whole, -0.5f, edge);
  const Float end = fma(whole, 0.5f, edge);
  return select(x <= start, 0.0f, select(x >= end, 1.0f, (x - start) / whole));
}

}  // namespace nacre
