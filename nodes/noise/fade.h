#pragma once

#include <optional>

#include "runtime/node/node_call.h"
#include "runtime/value/control.h"
#include "runtime/value/vector.h"

namespace nacre {

/// How far a footprint covers the cells of gradient noise, which are 1 wide: from 0, where it is a
/// point, to 1, from where nothing of the noise is left. Of p times s it is s^2 times as much.
///
/// The noise of a point, times what faded() leaves, is near what is best known by it of the average
/// over the footprint: the share c that makes the mean of (average - c noise)^2 least. Measured for
/// squares of any direction, FadeNoiseOfAverages.OfSquaresIsTheShareThatTellsMost: 1 - covered to
/// the fourth power is within .07 of that. Sums over squares of both axes stand for footprints that
/// are no squares: long ones fade sooner than that, by up to .25. NaN counts as no footprint.
/// @{
Float covered(Float2 p);
Float covered(Float3 p);
/// @}

/// That where the noise of a node fades.
template <class P>
std::optional<Float> covered(const NodeCall& call, P p) {
  return call.fades_noise() ? std::optional(covered(p)) : std::nullopt;
}

/// What of noise is left of 1.
inline Float left_of_noise(Float covered) {
  // NaN, of a footprint or of infinity times 0, covers nothing.
  const Float left = max(1.0f - max(covered, 0.0f), 0.0f);
  const Float square = left * left;
  return square * square;
}

/// noise(), Float or Float3, times what is left of it; not computed where that is nothing. All of
/// it where it does not fade.
template <class R, class Noise>
R faded(const std::optional<Float>& covered, Noise&& noise) {
  if (!covered) return noise();
  const Float left = left_of_noise(*covered);
  return if_any(left > 0.0f, R(0.0f), [&] { return R(left) * noise(); });
}

}  // namespace nacre
