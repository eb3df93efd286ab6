#pragma once

#include <cstdint>
#include <span>

namespace nacre::host {

/// Numbers for one image sample are a pure function of what they are for: no
/// state, so the image does not depend on who computes which pixel when.
enum class SamplerKind {
  sobol,        ///< Owen-scrambled (0,2)-sequences, padded: the default.
  independent,  ///< Uncorrelated; for statistics that assume so.
};

/// What a number decides. Every use at one path vertex has its own sequence.
enum class Draw : std::uint32_t {
  pixel,
  lens,
  opacity,
  light_choice,
  light,
  lobe,
  direction,
  roulette,
  time,
  flight,
  phase,
  shadow,
  texel,         ///< Of images, at what a path meets,
  light_texel,   ///< on what light sampling chose,
  shadow_texel,  ///< and on what stands between, by SampleKey::step.
};

struct Uniform2 {
  float x, y;  ///< Each in [0, 1).
};

struct SampleKey {
  std::uint32_t seed = 0;    ///< Of the render.
  std::uint32_t pixel = 0;   ///< y * width + x.
  std::uint32_t sample = 0;  ///< Index within the pixel.
  std::uint32_t event = 0;   ///< Intersections on the path so far.
  std::uint32_t step = 0;    ///< What a shadow ray has stopped at so far.
};

/// Two numbers for one purpose.
Uniform2 uniform2(SamplerKind kind, const SampleKey& key, Draw draw);
/// The same for many keys, to the bit, several at a time. As many numbers as keys.
void uniform2(SamplerKind kind, std::span<const SampleKey> keys, Draw draw,
              std::span<Uniform2> numbers);

}  // namespace nacre::host
