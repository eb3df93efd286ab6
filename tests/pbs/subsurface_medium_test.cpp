// What a half-space of the medium sends back, by means that know nothing of the fit.
#include "pbs/subsurface_medium.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace nacre {
namespace {

struct Coefficients {
  double scattering, extinction;
};

Coefficients grey(float albedo, float radius, float anisotropy) {
  const Vdf medium = subsurface_medium(Color3(albedo), Color3(radius), anisotropy);
  const double scattering = medium.scattering.y.constant();
  return {scattering, scattering + static_cast<double>(medium.absorption.y.constant())};
}

/// Nodes and weights for integrals over [0, 1]: Gauss and Legendre, by Newton's method.
struct Quadrature {
  std::vector<double> x, w;
  explicit Quadrature(int n) {
    for (int i = 0; i < n; ++i) {
      double t = std::cos(3.141592653589793 * (i + 0.75) / (n + 0.5)), slope = 0;
      for (int step = 0; step < 100; ++step) {
        double a = 1, b = t;
        for (int k = 2; k <= n; ++k) {
          const double c = ((2 * k - 1) * t * b - (k - 1) * a) / k;
          a = b, b = c;
        }
        slope = n * (t * b - a) / (t * t - 1);
        t -= b / slope;
      }
      x.push_back((1 + t) / 2);
      w.push_back(1 / ((1 - t * t) * slope * slope));
    }
  }
};

/// The spherical albedo of a half-space that scatters alike in all directions: 1 - 2 r h, with r =
/// sqrt(1 - a) and h the first moment of H, which solves 1 / H(m) = r + a / 2 times the integral of
/// m' H(m') / (m + m'). Chandrasekhar, "Radiative Transfer", 1960, chapter V, eq. 12.
double half_space(double a) {
  static const Quadrature q(64);
  const double r = std::sqrt(1 - a);
  std::vector<double> h(q.x.size(), 1.0);
  for (int round = 0; round < 400; ++round) {
    for (std::size_t i = 0; i < h.size(); ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < h.size(); ++j) sum += q.w[j] * q.x[j] * h[j] / (q.x[i] + q.x[j]);
      // Half of the step: the iteration swings around the root.
      h[i] = (h[i] + 1 / (r + a / 2 * sum)) / 2;
    }
  }
  double moment = 0;
  for (std::size_t i = 0; i < h.size(); ++i) moment += q.w[i] * q.x[i] * h[i];
  return 1 - 2 * r * moment;
}

TEST(SubsurfaceMedium, SendsBackTheAlbedo) {
  // A half-space of no scattering is black and one of no absorption white.
  ASSERT_NEAR(half_space(0.0), 0.0, 1e-9);
  ASSERT_NEAR(half_space(1.0), 1.0, 1e-9);
  for (const float albedo : {0.0f, 0.02f, 0.1f, 0.3f, 0.5f, 0.7f, 0.9f, 0.98f, 0.999f, 1.0f}) {
    const Coefficients of = grey(albedo, 1.0f, 0.0f);
    EXPECT_NEAR(half_space(of.scattering / of.extinction), albedo, 3e-3) << albedo;
  }
}

// Where scattering has a direction, by following light; in depths of the mean free path.
TEST(SubsurfaceMedium, SendsBackTheAlbedoWhateverItsAnisotropy) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const auto random = [&] { return uniform(generator); };
  for (const float g : {-0.6f, 0.5f, 0.85f}) {
    for (const float albedo : {0.2f, 0.6f, 0.85f}) {
      const Coefficients of = grey(albedo, 1.0f, g);
      const double share = of.scattering / of.extinction;
      const int n = 60000;
      double back = 0;
      for (int i = 0; i < n; ++i) {
        // Depth and the cosine to its axis are all that counts.
        double depth = 0, cosine = std::sqrt(random()), weight = 1;
        while (true) {
          depth -= std::log(1 - random()) * cosine;
          if (depth <= 0) {
            back += weight;
            break;
          }
          weight *= share;
          if (weight < 0.1) {
            if (random() < 0.5) break;
            weight *= 2;
          }
          const double u = 2 * random() - 1, f = (1 - double(g) * g) / (1 + double(g) * u);
          const double turn = (1 + double(g) * g - f * f) / (2 * double(g));
          const double sines = std::sqrt((1 - turn * turn) * (1 - cosine * cosine));
          cosine = cosine * turn + sines * std::cos(6.283185307179586 * random());
          cosine = std::max(-1.0, std::min(1.0, cosine));
        }
      }
      EXPECT_NEAR(back / n, albedo, 1.5e-2) << g << ' ' << albedo;
    }
  }
}

TEST(SubsurfaceMedium, IsAsDenseAsItsRadius) {
  for (const float g : {-0.9f, 0.0f, 0.9f}) {
    EXPECT_NEAR(grey(0.7f, 0.25f, g).extinction, 4.0, 1e-5) << g;
    EXPECT_NEAR(grey(1.0f, 8.0f, g).extinction, 0.125, 1e-7) << g;
  }
}

// Of white nothing is lost, and next to white the little that is has all its digits: s is (1 -
// albedo) / 2.309, and what is absorbed s².
TEST(SubsurfaceMedium, HasDigitsNextToWhite) {
  const Vdf white = subsurface_medium(Color3(1.0f), Color3(1.0f), 0.0f);
  EXPECT_EQ(white.absorption.x.constant(), 0.0f);
  const Vdf nearly = subsurface_medium(Color3(0x1.fffffep-1f), Color3(1.0f), 0.0f);
  const double s = 0x1p-24 / 2.309;
  EXPECT_NEAR(nearly.absorption.x.constant() / (s * s), 1.0, 1e-3);
}

TEST(SubsurfaceMedium, IsFiniteForAnything) {
  const float hostile[] = {0.0f, -1.0f, 1e-38f, 1e38f, INFINITY, -INFINITY, NAN};
  for (const float radius : hostile) {
    for (const float g : hostile) {
      const Vdf medium = subsurface_medium(Color3(0.5f), Color3(radius), g);
      const float absorption = medium.absorption.x.constant();
      const float scattering = medium.scattering.x.constant();
      EXPECT_TRUE(std::isfinite(absorption) && absorption >= 0.0f) << radius << ' ' << g;
      EXPECT_TRUE(std::isfinite(scattering) && scattering >= 0.0f) << radius << ' ' << g;
      EXPECT_LE(std::abs(medium.anisotropy.constant()), 0.999f) << g;
    }
  }
}

}  // namespace
}  // namespace nacre
