#pragma once

#include "tests/pbs/independent/vector.h"

namespace nacre::reference {

/// Estevez and Kulla, "Production Friendly Microfacet Sheen BRDF", SIGGRAPH 2017 course notes, with
/// the shadowing of MaterialX 1.39: seen along one wo above. Where more would come back than
/// arrives, divided by that, here by its integral (the lobe has a fit).
class FibreSheen {
 public:
  FibreSheen(double roughness, Vec wo);
  Scattered at(Vec wi) const;
  double albedo() const { return albedo_; }

 private:
  double once(Vec wi) const;
  double roughness_;
  Vec wo_;
  double scale_, albedo_;
};

/// Zeltner, Burley and Chiang, "Practical Multiple-Scattering Sheen Using Linearly Transformed
/// Cosines", SIGGRAPH 2022 talks: Heitz et al.'s transformed cosine (2016, eq. 1 and 2) by the
/// matrix and the albedo that MaterialX 1.39 has fitted to its tables.
class TransformedSheen {
 public:
  TransformedSheen(double roughness, Vec wo);
  Scattered at(Vec wi) const;
  double albedo() const { return albedo_; }

 private:
  Vec wo_;
  double a_, b_, albedo_;
};

}  // namespace nacre::reference
