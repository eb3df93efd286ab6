// chiang_hair_bsdf against the formulas of its papers, in double.
#include "tests/pbs/independent/hair.h"

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

using reference::Fibre;
using reference::Hair;
using reference::Scattered;
using reference::Vec;

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

Columns directions(const std::vector<Vec>& wo, const std::vector<Vec>& wi) {
  Columns columns{{"N.z", {1.0f}}, {"T.x", {1.0f}}};
  const auto put = [&](const std::string& name, const std::vector<Vec>& list) {
    for (const Vec& w : list) {
      columns[name + ".x"].push_back(static_cast<float>(w.x));
      columns[name + ".y"].push_back(static_cast<float>(w.y));
      columns[name + ".z"].push_back(static_cast<float>(w.z));
    }
  };
  put("wo", wo), put("wi", wi);
  return columns;
}

/// Unit as floats are, which is what kernels are given.
Vec random_direction(Random& random, bool above) {
  const auto number = [&] { return static_cast<double>(random.word() >> 11) * 0x1p-53; };
  const double z = above ? number() : 2.0 * number() - 1.0;
  const double phi = 2.0 * pi_d * number();
  const double r = std::sqrt(1.0 - z * z);
  const Vec w{r * std::cos(phi), r * std::sin(phi), z};
  return reference::unit(
      {static_cast<float>(w.x), static_cast<float>(w.y), static_cast<float>(w.z)});
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
    std::vector<Vec> wo, wi;
    for (int i = 0; i < 4000; ++i) {
      wo.push_back(random_direction(random, true)), wi.push_back(random_direction(random, false));
    }
    const Kernels recorded(fibre);
    const auto kernel =
        make_reference(slice(recorded.recorder.program(), "evaluate", recorded.kernels.evaluate));
    const DoubleColumns found = run_double(*kernel, directions(wo, wi));
    for (std::size_t i = 0; i < wo.size(); ++i) {
      const Scattered expected = Hair(fibre, wo[i]).at(wi[i]);
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
    std::vector<Vec> wo, wi;
    for (int i = 0; i < 4000; ++i) {
      const Vec o = random_direction(random, true);
      const double spread =
          3.0 * std::sqrt(v) * (static_cast<double>(random.below(2001)) - 1000) / 1000;
      const double elevation = std::clamp(-std::asin(o.x) + spread, -1.5, 1.5);
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
      if (std::hypot(wo[i].y, wo[i].z) < 0.05) continue;  // Floats hardly tell the azimuth.
      const double expected = Hair(fibre, wo[i]).at(wi[i]).f;
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
    std::vector<Vec> wo;
    for (int i = 0; i < 1000; ++i) wo.push_back(random_direction(random, true));
    const DoubleColumns found = run_double(*kernel, directions(wo, {}));
    for (const double albedo : found.at("albedo.x")) EXPECT_NEAR(albedo, 1.0, 1e-6);
  }
}

}  // namespace
}  // namespace nacre
