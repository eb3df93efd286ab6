#pragma once

#include <cstdint>

namespace nacre::host {

/// How long a path goes on once it has had RenderSettings::roulette_depth scattering events. All
/// have the same mean.
enum class Roulette {
  none,        ///< To its end.
  throughput,  ///< With the probability of what light it would still carry.
  /// With the root of what of that the last event has left (Langlands 2014, "Physically Based
  /// Shader Design in Arnold", equation 1): a path is not ended for what it lost before.
  event,
};

/// Ways to an image of less noise in the same time, some of them to another image: Langlands 2014,
/// section 6. As they stand here none is taken but what changes no mean.
struct Techniques {
  /// Whether surfaces scatter by gloss, and as mirrors and glass, what a path brings to where it
  /// was scattered diffusely before. Else that light is missing (6.1).
  bool caustics = true;
  /// Behind a rough lobe facets are at least as rough (6.1).
  bool clamps_roughness = false;
  /// Images give one of the texels that their filter weighs, drawn anew for each point: look-ups
  /// take less time, and what filtering takes from an image is noise that more samples take.
  bool draws_texels = false;
  Roulette roulette = Roulette::throughput;
  /// So many scattering events follow both what a surface reflects and what it lets through; later
  /// ones one of both, drawn by what they carry (6.2). At most max_split_events.
  int split_events = 0;
  /// What one contribution brings at most, in each channel, once a path has had a scattering event:
  /// more is scaled down to it (6.3). 0: any.
  float indirect_limit = 0.f;

  /// Whether shaders are to tell lobes apart: ShadingBatch::lobes_wanted.
  bool chooses_lobes() const { return !caustics || clamps_roughness || split_events > 0; }
};

inline constexpr int max_split_events = 6;

}  // namespace nacre::host
