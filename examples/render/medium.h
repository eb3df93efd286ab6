#pragma once

#include <cstdint>

#include "examples/render/sampler.h"
#include "examples/render/vec.h"

namespace nacre::host {

/// What fills the space between surfaces: per unit of length, by channel.
struct Medium {
  static constexpr std::uint32_t everywhere = ~0u;

  Vec3 absorption;
  Vec3 scattering;
  float anisotropy = 0.f;  ///< Mean cosine of scattering, in (-1, 1).
  Vec3 emission = {};
  /// Its border is no surface: light goes straight through.
  bool is_open = false;
  /// Of what differs from place to place: the index of the material that says what there is, and
  /// what absorption and scattering together rarely exceed. The numbers above mean nothing then.
  std::uint32_t varies_by = everywhere;
  float bound = 0.f;

  bool varies() const { return varies_by != everywhere; }
  bool is_empty() const {
    return !varies() && max_component(absorption) <= 0.f && max_component(scattering) <= 0.f &&
           max_component(emission) <= 0.f;
  }
};

/// What differs from place to place: see Medium::varies_by and Medium::bound.
inline Medium varying_medium(std::uint32_t material, float bound) {
  Medium medium;
  medium.is_open = true;
  medium.varies_by = material;
  medium.bound = bound;
  return medium;
}

/// What happens to light on its way to the next surface.
struct Flight {
  bool scatters = false;
  float distance = 0.f;  ///< To where it does.
  Vec3 weight;           ///< Factor of its throughput.
};

/// Draws how far light goes, at most to `far`, which may be infinite: by the free path of a
/// channel, which is drawn by `throughput`; weighted by all channels (Wilkie et al., "Hero
/// Wavelength Spectral Sampling", EGSR 2014, eq. 4).
Flight sample_flight(const Medium& medium, Vec3 throughput, float far, Uniform2 u);

/// The share of light that goes as far in a medium alike everywhere, by channel (Beer's law).
Vec3 transmittance(const Medium& medium, float length);

/// What a medium alike everywhere sends along a ray of that length, by channel: the integral of
/// what is left of its emission. Of a ray without end in what does not absorb: nothing.
Vec3 emitted(const Medium& medium, float length);

/// Where light might be met on its way through something of that bound; infinite: nowhere.
float sample_bound(float bound, float u);

/// What happens there. Light goes on as it was where nothing is: the bound is made up by what
/// neither absorbs nor scatters (Woodcock et al. 1965; with weights by channel Kutz et al.,
/// "Spectral and Decomposition Tracking", SIGGRAPH 2017, section 4). Where there is more than the
/// bound the weights have both signs, and the mean stays.
struct Meeting {
  bool scatters = false;
  Vec3 weight;  ///< Factor of the light's throughput; the rest is absorbed.
};
Meeting sample_meeting(const Medium& there, float bound, Vec3 throughput, float u);

/// Where light that goes along the unit vector `along` is scattered to, and its density by solid
/// angle; Henyey and Greenstein, "Diffuse radiation in the galaxy", 1941, eq. 2, inverted without a
/// division by the anisotropy.
struct Scattered {
  Vec3 direction;
  float pdf = 0.f;
};
Scattered sample_phase(float anisotropy, Vec3 along, Uniform2 u);

/// The density with which light that goes along one unit vector is scattered to another: the phase
/// function too.
float phase(float anisotropy, Vec3 along, Vec3 to);

}  // namespace nacre::host
