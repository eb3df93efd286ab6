#pragma once

#include "runtime/program/program.h"
#include "runtime/value/vector.h"

namespace nacre {

/// A thin dielectric film on an interface, as RGB reflectance: Belcour and Barla,
/// "A Practical Extension to Microfacet Theory for the Modeling of Varying
/// Iridescence", SIGGRAPH 2017. Airy's sum over the orders of interference, each
/// averaged over Gaussian sensitivities, to `terms` orders.
///
/// Where it differs from MaterialX's code: amplitudes are complex numbers instead
/// of magnitudes and arctangents, which is finite everywhere; each channel of the
/// substrate goes into that channel of the result, so coloured metals stay as
/// they are when the film thins out; sensitivities are normalized to 1. Below
/// 30 nm the film fades into the bare interface (smoothstep), without a seam.
/// Total reflection at the film counts as 1: light that tunnels is left out.
class ThinFilm {
 public:
  /// Orders of interference of `precise`, where the path through the film is not so short that
  /// it takes wave number by wave number.
  static constexpr int precise_terms = 10;

  /// No film.
  ThinFilm() = default;
  /// thickness in nm, in [0, 1e6]; index in [1, 50]: clamped.
  ThinFilm(Float thickness, Float index, Accuracy accuracy);

  /// False where the thickness is a literal 0: nothing to record.
  bool exists() const { return !thickness_.is_constant(0.0f); }

  /// How far what holds for the interface without it does not: 0 without, 1 from 30 nm on; a
  /// literal 0 where there is none.
  Float share() const { return exists() ? saturate(thickness_ * (1.0f / 30.0f)) : Float(0.0f); }

  /// As FacetFresnel::presence, where `bare` is that without the film.
  Color3 presence(Color3 bare) const {
    return exists() ? select(thickness_ > 0.0f, Color3(1.0f), bare) : bare;
  }

  /// The same for a sum over many cosines, in which what higher orders add cancels: no more orders
  /// than these, and no wave numbers one by one.
  ThinFilm in_sums() const;
  static constexpr int most_terms_in_sums = 5;

  /// Reflectance in [0, 1]. cosine: of the ray in the medium of index `before`
  /// (at least 0.02); n + ik: index of the substrate, as `before` relative to vacuum,
  /// in [0, 1e4] each. `bare`: without the film.
  Color3 reflectance(Float cosine, Float before, Color3 n, Color3 k, Color3 bare) const;

  /// The members, to be kept.
  template <class F>
  friend void visit(ThinFilm& film, F&& f) {
    f(film.thickness_), f(film.index_);
  }

 private:
  Float thickness_ = 0.0f;
  Float index_ = 1.5f;
  /// Orders of interference: fast 2, standard 3, precise 10. Those left out are a few hundredths
  /// for most films, but where both interfaces reflect nearly all, at grazing angles, 0.48 and 0.41
  /// at worst (found by search, tests/pbs/thin_film_test.cpp); `precise` is within 0.005
  /// everywhere.
  int terms_ = 3;
};

}  // namespace nacre
