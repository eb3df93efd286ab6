#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "nodes/noise/fade.h"
#include "nodes/noise/perlin.h"
#include "nodes/noise/record_noise.h"
#include "runtime/node/node_call.h"
#include "runtime/value/control.h"

namespace nacre {

/// More octaves than this are not summed: by then the coordinates have lost their
/// fraction or the amplitudes have vanished.
inline constexpr int most_octaves = 64;

/// The octaves of a fractal: how many, and what the coordinates and the amplitude
/// are multiplied by from one to the next.
struct Octaves {
  Int count;
  Float lacunarity, diminish;

  explicit Octaves(const NodeCall& call)
      : count(call.integer("octaves")),
        lacunarity(call.number("lacunarity")),
        diminish(call.number("diminish")) {}
};

/// Whether what is within_reach() is finite after so many factors.
inline bool stays_finite(Float factor, int times) {
  return factor.is_constant() && std::pow(std::abs(factor.constant()), times) <= 0x1p64;
}

inline Float2 scaled(Float2 p, Float s) { return p * s; }
inline Float3 scaled(Float3 p, Float s) { return p * Float3(s); }

template <class P, class R>
struct FractalState {
  P p;
  Float amplitude;
  R sum;
  std::optional<Float> covered;  ///< See covered() (fade.h); nothing where noise does not fade.
};
template <class P, class R, class F>
void visit(FractalState<P, R>& s, F&& f) {
  visit(s.p, f);
  visit(s.amplitude, f);
  visit(s.sum, f);
  if (s.covered) visit(*s.covered, f);
}

/// Sum over i < count of diminish^i noise(lacunarity^i p); 0 for no octaves. R is
/// Float or Float3. A literal count is written out, another one loops. Octaves fade by what the
/// footprint of p has `covered`, if anything; those of which nothing is left are not computed.
template <class R, class P, class Noise>
R fractal(Recorder& recorder, P p, const Octaves& octaves, std::optional<Float> covered,
          Noise&& noise) {
  FractalState<P, R> state{p, 1.0f, R(0.0f), covered};
  const bool is_known = octaves.count.is_constant();
  const int most = is_known ? std::min(octaves.count.constant(), most_octaves) : most_octaves;
  // Infinite coordinates have no noise, nor has an infinite amplitude one where that is 0.
  const bool are_near = stays_finite(octaves.lacunarity, most);
  const bool is_small = stays_finite(octaves.diminish, most);
  const auto octave = [&](FractalState<P, R>& s) {
    s.sum = s.sum + R(s.amplitude) * faded<R>(s.covered, [&] { return noise(s.p); });
    s.amplitude *= octaves.diminish;
    s.p = scaled(s.p, octaves.lacunarity);
    if (!is_small) s.amplitude = min(0x1p120f, max(-0x1p120f, s.amplitude));  // NaN stays.
    if (!are_near) s.p = within_reach(s.p);
    if (s.covered) *s.covered *= octaves.lacunarity * octaves.lacunarity;
  };
  if (is_known) {
    for (int i = 0; i < most; ++i) octave(state);
    return state.sum;
  }
  const auto body = [&](Int i, FractalState<P, R>& s) {
    octave(s);
    return i + Int(1) < octaves.count;
  };
  return loop(recorder, octaves.count > Int(0), most_octaves, state, body).sum;
}

}  // namespace nacre
