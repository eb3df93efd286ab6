#pragma once

#include "runtime/node/node_call.h"
#include "runtime/value/vector.h"

namespace nacre {

/// p limited to 2^60, NaN to its lower end: far beyond where noise is 0 everywhere,
/// so nothing changes but that infinity has a value, and that an octave of a fractal
/// may double it 64 times. Once a node, for all that it evaluates.
inline Float within_reach(Float x) { return min(max(x, -0x1p60f), 0x1p60f); }
inline Float2 within_reach(Float2 p) { return {within_reach(p.x), within_reach(p.y)}; }
inline Float3 within_reach(Float3 p) {
  return {within_reach(p.x), within_reach(p.y), within_reach(p.z)};
}

/// Sets one to four noises by the type of the output, each times its component of
/// "amplitude" plus `pivot`. `one(p)` and `three(p)` are the noise; two of them are
/// the first of three, the fourth is one at p + shift unless `pair` says that two
/// are one(p) and one(p + shift) as well.
template <class P, class One, class Three>
void record_noise(NodeCall& call, P p, P shift, bool pair, Float pivot, One&& one, Three&& three) {
  p = within_reach(p);
  const Recorded& amplitude = call.in("amplitude");
  std::vector<Float> values;
  switch (call.out_type()) {
    case Type::float_: values = {one(p)}; break;
    case Type::vector2:
      if (pair) {
        values = {one(p), one(p + shift)};
        break;
      }
      [[fallthrough]];
    default: {
      const Float3 v = three(p);
      values = {v.x, v.y, v.z};
    }
  }
  if (call.out_type() == Type::vector4) values.push_back(one(p + shift));
  std::vector<Ref> parts;
  for (std::size_t i = 0; i < amplitude.parts.size(); ++i) {
    parts.push_back(fma(values[i], amplitude.number(i), pivot).ref());
  }
  call.set(std::move(parts));
}

}  // namespace nacre
