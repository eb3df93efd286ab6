// chiang_hair_bsdf against the formulas of its papers, in double.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "jit/passes/expand_math.h"
#include "runtime/interpreter/interpreter.h"
#include "tests/support/closure.h"
#include "tests/support/random.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

constexpr double pi_d = std::numbers::pi;

struct Fibre {
  double index = 1.55;
  std::array<double, 3> variance{0.0065, 0.0016, 0.026};
  std::array<double, 3> scale{0.04, 0.04, 0.04};  ///< Chiang's s.
  double tilt = 0.0;                              ///< Radians.
  double absorption = 0.0;
};

using Vector = std::array<double, 3>;  ///< Along the fibre, across, and along the normal.

/// d'Eon et al. 2011, eq. 7. Below a variance of 0.01 by the asymptotic series of I0 (DLMF
/// 10.40.1), which is exact to 1e-9 there but where a cosine is next to nothing.
double longitudinal(double sin_i, double cos_i, double sin_o, double cos_o, double v) {
  const double x = cos_i * cos_o / v;
  const double b = sin_i * sin_o / v;
  if (x < 500.0) {
    const double log_i0 = std::log(std::cyl_bessel_i(0.0, x));
    return std::exp(log_i0 - b - 1.0 / v) / (v * -std::expm1(-2.0 / v));
  }
  double series = 1.0, term = 1.0;
  for (int k = 1; k < 8; ++k) series += term *= (2.0 * k - 1) * (2.0 * k - 1) / (8.0 * k * x);
  return series / std::sqrt(2.0 * pi_d * x) * std::exp(x - b - 1.0 / v) / v;
}

double logistic(double x, double s) {
  s *= std::sqrt(pi_d / 8.0);
  const auto below = [&](double y) { return 1.0 / (1.0 + std::exp(-y / s)); };
  const double e = std::exp(-std::abs(x) / s);
  return e / (s * (1.0 + e) * (1.0 + e)) / (below(pi_d) - below(-pi_d));
}

double fresnel(double cosine, double index) {
  const double out = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
  const double s = (cosine - index * out) / (cosine + index * out);
  const double p = (index * cosine - out) / (index * cosine + out);
  return 0.5 * (s * s + p * p);
}

struct Scattered {
  double f, pdf, albedo;
};

Scattered scattered(const Fibre& fibre, Vector wo, Vector wi) {
  const double sin_o = wo[0], cos_o = std::hypot(wo[1], wo[2]);
  const double sin_i = wi[0], cos_i = std::hypot(wi[1], wi[2]);
  const double turn = std::atan2(wi[2], wi[1]) - std::atan2(wo[2], wo[1]);
  const double h = -wo[1] / cos_o;
  const double outside = std::asin(h);
  const double bent = std::sqrt(fibre.index * fibre.index - sin_o * sin_o) / cos_o;
  const double inside = std::asin(h / bent);
  const double cos_t = std::sqrt(1.0 - sin_o * sin_o / (fibre.index * fibre.index));
  const double passed = std::exp(-fibre.absorption * 2.0 * std::cos(inside) / cos_t);
  const double reflected = fresnel(cos_o * std::cos(outside), fibre.index);
  std::array<double, 4> share{};
  share[0] = reflected;
  share[1] = (1.0 - reflected) * (1.0 - reflected) * passed;
  share[2] = share[1] * passed * reflected;
  share[3] = share[2] * passed * reflected / (1.0 - passed * reflected);
  Scattered sum{};
  for (const double one : share) sum.albedo += one;
  for (int p = 0; p < 4; ++p) {
    const auto way = static_cast<std::size_t>(std::min(p, 2));
    const double tilt = p == 3 ? 0.0 : (2.0 - 3.0 * p) * fibre.tilt;
    const double elevation = std::atan2(sin_o, cos_o) + tilt;
    const double m = longitudinal(sin_i, cos_i, std::sin(elevation), std::abs(std::cos(elevation)),
                                  fibre.variance[way]);
    const double exit = 2.0 * p * inside - 2.0 * outside + p * pi_d;
    const double n =
        p == 3 ? 0.5 / pi_d : logistic(std::remainder(turn - exit, 2.0 * pi_d), fibre.scale[way]);
    sum.f += share[static_cast<std::size_t>(p)] * m * n;
  }
  sum.pdf = sum.f / sum.albedo;  // White tints.
  return sum;
}

struct Kernels {
  explicit Kernels(const Fibre& fibre) {
    const auto f = [](double x) { return Float(static_cast<float>(x)); };
    Ports ports{{"ior", number(f(fibre.index))},
                {"absorption_coefficient", colour(f(fibre.absorption))},
                {"cuticle_angle", number(f(0.5 + fibre.tilt / pi_d))}};
    constexpr std::array names{"R", "TT", "TRT"};
    for (std::size_t i = 0; i < names.size(); ++i) {
      ports[std::string("tint_") + names[i]] = colour(1.0f);
      ports[std::string("roughness_") + names[i]] =
          roughness(f(fibre.variance[i]), f(fibre.scale[i]));
    }
    Surface surface;
    surface.bsdf = microfacet_bsdf(recorder, "chiang_hair_bsdf", std::move(ports));
    kernels = record_kernels(recorder, surface, Accuracy::standard, {});
  }
  Recorder recorder;
  SurfaceKernels kernels;
};

Columns directions(const std::vector<Vector>& wo, const std::vector<Vector>& wi) {
  Columns columns{{"N.z", {1.0f}}, {"T.x", {1.0f}}};
  const auto put = [&](const std::string& name, const std::vector<Vector>& list) {
    constexpr std::array axes{".x", ".y", ".z"};
    for (const Vector& w : list) {
      for (std::size_t i = 0; i < 3; ++i) {
        columns[name + axes[i]].push_back(static_cast<float>(w[i]));
      }
    }
  };
  put("wo", wo), put("wi", wi);
  return columns;
}

/// Unit as floats are, which is what kernels are given.
Vector random_direction(Random& random, bool above) {
  const auto number = [&] { return static_cast<double>(random.word() >> 11) * 0x1p-53; };
  const double z = above ? number() : 2.0 * number() - 1.0;
  const double phi = 2.0 * pi_d * number();
  const double r = std::sqrt(1.0 - z * z);
  Vector w{r * std::cos(phi), r * std::sin(phi), z};
  double length = 0.0;
  for (double& x : w) x = static_cast<float>(x), length += x * x;
  for (double& x : w) x /= std::sqrt(length);
  return w;
}

const std::vector<Fibre>& fibres() {
  static const std::vector<Fibre> list{
      {},
      {.variance = {0.3, 0.1, 1.0}, .scale = {0.5, 0.5, 0.5}, .absorption = 0.4},
      {.index = 1.3, .variance = {0.05, 0.02, 0.1}, .tilt = 0.06, .absorption = 1.5},
      {.variance = {27.0, 6.9, 100.0}, .scale = {6.8, 6.8, 6.8}},
  };
  return list;
}

TEST(Hair, IsTheModelOfItsPapers) {
  for (const Fibre& fibre : fibres()) {
    Random random(5);
    std::vector<Vector> wo, wi;
    for (int i = 0; i < 4000; ++i) {
      wo.push_back(random_direction(random, true)), wi.push_back(random_direction(random, false));
    }
    const Kernels recorded(fibre);
    const auto kernel =
        make_reference(slice(recorded.recorder.program(), "evaluate", recorded.kernels.evaluate));
    const DoubleColumns found = run_double(*kernel, directions(wo, wi));
    for (std::size_t i = 0; i < wo.size(); ++i) {
      const Scattered expected = scattered(fibre, wo[i], wi[i]);
      if (expected.f < 1e-12) continue;
      // The polynomials of the Bessel function are good to 2e-7; inputs are floats.
      ASSERT_NEAR(found.at("f.x")[i], expected.f, 2e-5 * expected.f + 1e-9) << i;
      ASSERT_NEAR(found.at("pdf")[i], expected.pdf, 2e-5 * expected.pdf + 1e-9) << i;
    }
  }
}

/// In float, where the published form loses a third of the light: near the peak of each way.
TEST(Hair, SmoothFibresKeepTheirDigits) {
  for (const double v : {5e-7, 1e-6, 1e-4, 1e-2, 1.0}) {
    const Fibre fibre{.variance = {v, v, v}};
    Random random(6);
    std::vector<Vector> wo, wi;
    for (int i = 0; i < 4000; ++i) {
      const Vector o = random_direction(random, true);
      const double spread =
          3.0 * std::sqrt(v) * (static_cast<double>(random.below(2001)) - 1000) / 1000;
      const double elevation = std::clamp(-std::asin(o[0]) + spread, -1.5, 1.5);
      const double azimuth = 2.0 * pi_d * random.below(1000) / 1000.0;
      wo.push_back(o);
      wi.push_back({std::sin(elevation), std::cos(elevation) * std::cos(azimuth),
                    std::cos(elevation) * std::sin(azimuth)});
    }
    const Kernels recorded(fibre);
    const auto kernel = make_interpreter(
        expand_math(slice(recorded.recorder.program(), "evaluate", recorded.kernels.evaluate),
                    Accuracy::standard));
    const Columns found = run(*kernel, directions(wo, wi));
    for (std::size_t i = 0; i < wo.size(); ++i) {
      if (std::hypot(wo[i][1], wo[i][2]) < 0.05) continue;  // Floats hardly tell the azimuth.
      const double expected = scattered(fibre, wo[i], wi[i]).f;
      ASSERT_NEAR(found.at("f.x")[i], expected, 5e-3 * expected + 1e-6) << v << ' ' << i;
    }
  }
}

TEST(Hair, WhiteFibresReturnAllLight) {
  for (const Fibre& fibre : fibres()) {
    Fibre white = fibre;
    white.absorption = 0.0;
    const Kernels recorded(white);
    const auto kernel =
        make_reference(slice(recorded.recorder.program(), "albedo", recorded.kernels.albedo));
    Random random(7);
    std::vector<Vector> wo;
    for (int i = 0; i < 1000; ++i) wo.push_back(random_direction(random, true));
    const DoubleColumns found = run_double(*kernel, directions(wo, {}));
    for (const double albedo : found.at("albedo.x")) EXPECT_NEAR(albedo, 1.0, 1e-6);
  }
}

}  // namespace
}  // namespace nacre
