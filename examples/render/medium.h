#pragma once

#include <array>
#include <cstdint>

#include "examples/render/sampler.h"
#include "examples/render/vec.h"

namespace nacre::host {

/// What fills the space between surfaces, everywhere alike: per unit of length, by channel.
struct Medium {
  Vec3 absorption;
  Vec3 scattering;
  float anisotropy = 0.f;  ///< Mean cosine of scattering, in (-1, 1).

  bool is_empty() const {
    return max_component(absorption) <= 0.f && max_component(scattering) <= 0.f;
  }
};

/// What a path is inside of. What was entered last is what there is; what encloses it comes back
/// when it is left.
class Media {
 public:
  static constexpr std::uint32_t no_exit = ~0u;

  bool empty() const { return count_ == 0; }
  /// Not empty() before.
  const Medium& current() const { return inside_[count_ - 1].medium; }

  /// False, and nothing is done, where more is nested than anybody nests. `exit`: the material
  /// that light meets on the inside of that mesh, if another than on the outside.
  bool enter(std::uint32_t mesh, std::uint32_t instance, const Medium& medium,
             std::uint32_t exit = no_exit);
  /// `exit` of what the path is inside of, if that is this mesh; else no_exit.
  std::uint32_t exit(std::uint32_t mesh, std::uint32_t instance) const;
  /// Nothing is done where the path is not inside of that.
  void leave(std::uint32_t mesh, std::uint32_t instance);

 private:
  struct Inside {
    std::uint32_t mesh, instance;
    Medium medium;
    std::uint32_t exit;
  };
  std::array<Inside, 4> inside_ = {};
  std::uint32_t count_ = 0;
};

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

/// Where light that goes along the unit vector `along` is scattered to, and its density by solid
/// angle; Henyey and Greenstein, "Diffuse radiation in the galaxy", 1941, eq. 2, inverted without a
/// division by the anisotropy.
struct Scattered {
  Vec3 direction;
  float pdf = 0.f;
};
Scattered sample_phase(float anisotropy, Vec3 along, Uniform2 u);

}  // namespace nacre::host
