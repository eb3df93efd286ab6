#pragma once

#include <array>
#include <complex>

/// A film on a substrate by the book: Born and Wolf, "Principles of Optics" (7th
/// ed.), 1.6.4, one wavelength at a time, in complex double arithmetic.
namespace nacre::reference {

/// Unpolarised reflectance seen from vacuum. `phase`: 4 pi n d cos / wavelength of
/// one passage there and back; `index` of the film, `substrate` n + ik, k >= 0.
double thin_film(double cosine, double phase, double index, std::complex<double> substrate);

/// Its mean over all phases: a film thicker than light is coherent.
double mean_over_phases(double cosine, double index, std::complex<double> substrate);

/// Sensitivities x, y, z at a wavelength in nm, per nm, in any common unit.
using Sensitivity = std::array<double, 3> (*)(double wavelength);

/// The Gaussians in wave number of Belcour and Barla 2017.
std::array<double, 3> gaussian_sensitivity(double wavelength);
/// The CIE 1931 observer as fitted by Wyman, Sloan and Shirley, "Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013.
std::array<double, 3> observer_sensitivity(double wavelength);

/// Linear RGB (CIE 1931 primaries, equal-energy white) of a film of this
/// thickness in nm under equal-energy light.
std::array<double, 3> thin_film_rgb(double cosine, double thickness, double index,
                                    std::complex<double> substrate, Sensitivity sensitivity);

}  // namespace nacre::reference
