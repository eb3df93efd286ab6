#pragma once

#include <complex>

namespace nacre::reference {

/// Unpolarised reflectance of a smooth interface by Fresnel's amplitudes: Born and Wolf,
/// "Principles of Optics" (7th ed.), 1.5.2 and 14.2. `index`: of what is beyond over what is
/// before, n + ik.
double fresnel(double cosine, std::complex<double> index);
/// The same of two dielectrics; 1 under total reflection.
double fresnel(double cosine, double index);
bool totally_reflected(double cosine, double index);

/// Schlick's curve from r0 to r90, less what makes the reflectance at acos(1/7) that of the curve
/// times r82. Hoffman, "Generalization of Adobe's Fresnel Model", 2023, eq. 4 to 6.
struct Schlick {
  double r0, r82, r90, exponent;
  double at(double cosine) const;
  /// The index whose reflectance at normal incidence is r0, which is in [0.01, 0.99] here.
  double index() const;
};

}  // namespace nacre::reference
