#include "tests/pbs/independent/thin_film.h"

#include <cmath>
#include <numbers>

namespace nacre::reference {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

}  // namespace

double thin_film(double cosine, double phase, double index, Complex substrate) {
  const double sine2 = 1.0 - cosine * cosine;
  const Complex in_film = std::sqrt(Complex(1.0 - sine2 / (index * index)));
  const Complex behind = std::sqrt(1.0 - sine2 / (substrate * substrate));
  const Complex turn = std::polar(1.0, phase);
  double sum = 0.0;
  for (const bool s : {true, false}) {
    const auto amplitude = [&](Complex n1, Complex c1, Complex n2, Complex c2) {
      return s ? (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2)
               : (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
    };
    const Complex front = amplitude(1.0, cosine, index, in_film);
    const Complex back = amplitude(index, in_film, substrate, behind);
    sum += 0.5 * std::norm((front + back * turn) / (1.0 + front * back * turn));
  }
  return sum;
}

double mean_over_phases(double cosine, double index, Complex substrate) {
  const int steps = 2000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i) {
    sum += thin_film(cosine, 2.0 * pi * i / steps, index, substrate) / steps;
  }
  return sum;
}

std::array<double, 3> gaussian_sensitivity(double wavelength) {
  const double wave_number = 1e9 / wavelength;
  const auto curve = [&](double amplitude, double mean, double half_variance) {
    // Height of the Gaussian whose transform has the amplitude given there.
    const double offset = wave_number - mean;
    return amplitude * std::exp(-offset * offset / (4.0 * half_variance));
  };
  // Per nm of wavelength.
  const double density = wave_number / wavelength;
  return {density * (curve(5.4856e-13, 1.6810e6, 4.3278e9) + curve(9.7470e-14, 2.2399e6, 4.5282e9)),
          density * curve(4.4201e-13, 1.7953e6, 9.3046e9),
          density * curve(5.2481e-13, 2.2084e6, 6.6121e9)};
}

std::array<double, 3> observer_sensitivity(double wavelength) {
  const auto lobe = [&](double mean, double below, double above) {
    const double t = (wavelength - mean) * (wavelength < mean ? below : above);
    return std::exp(-0.5 * t * t);
  };
  return {0.362 * lobe(442.0, 0.0624, 0.0374) + 1.056 * lobe(599.8, 0.0264, 0.0323) -
              0.065 * lobe(501.1, 0.0490, 0.0382),
          0.821 * lobe(568.8, 0.0213, 0.0247) + 0.286 * lobe(530.9, 0.0613, 0.0322),
          1.217 * lobe(437.0, 0.0845, 0.0278) + 0.681 * lobe(459.0, 0.0385, 0.0725)};
}

std::array<double, 3> thin_film_rgb(double cosine, double thickness, double index,
                                    Complex substrate, Sensitivity sensitivity) {
  const double inner = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
  std::array<double, 3> xyz{};
  std::array<double, 3> white{};
  for (double wavelength = 300.25; wavelength < 900.0; wavelength += 0.5) {
    const double phase = 4.0 * pi * index * thickness * inner / wavelength;
    const double reflected = thin_film(cosine, phase, index, substrate);
    const std::array<double, 3> seen = sensitivity(wavelength);
    for (std::size_t c = 0; c < 3; ++c) xyz[c] += seen[c] * reflected, white[c] += seen[c];
  }
  const double x = xyz[0] / white[0];
  const double y = xyz[1] / white[1];
  const double z = xyz[2] / white[2];
  return {2.3706743 * x - 0.9000405 * y - 0.4706338 * z,
          -0.5138850 * x + 1.4253036 * y + 0.0885814 * z,
          0.0052982 * x - 0.0146949 * y + 1.0093968 * z};
}

}  // namespace nacre::reference
