#pragma once

#include <string>
#include <vector>

#include "tests/pbs/battery/closure_kernels.h"

namespace nacre {

/// A law that points break.
struct ClosureFault {
  std::string law;        ///< "f > 0 needs pdf > 0"
  std::size_t count = 0;  ///< Of the points that break it.
  std::size_t first = 0;  ///< The first of them.
  std::string found;      ///< There: "f.x = 3, pdf = 0".
};

/// Runs all kernels of a closure over these points and tries what they promise for any bits:
///
///   evaluate  f, pdf and pdf_reverse finite and not negative; light only where pdf > 0
///   sample    the same of weight; wi unit to 1e-5 where valid, else weight and pdf are 0; where
///             not delta, `evaluate` of wi has that pdf, to the bit but for `fast`, and weight
///             times pdf is f
///   albedo, opacity, presence, opacity_color, roughness  in [0, 1]
///   emission, transmission  finite and not negative; with emission a pdf that is finite, not
///             negative, and above 0 where there is light
///   emit      emitted unit to 1e-5; weight and pdf finite and not negative, both 0 where one is;
///             `emission` along it has that pdf, to the bit but for `fast`, and weight times pdf is
///             emission times the cosine to Ng
///   interior, subsurface, media  coefficients finite and not negative, eta positive, anisotropy
///             in [-1, 1]
///   lights    intensity and direction finite, distance not negative; direction unit, or 0 where
///             there is none
std::vector<ClosureFault> try_laws(const ClosureKernels& kernels, const Arrays& points,
                                   std::size_t count);

}  // namespace nacre
