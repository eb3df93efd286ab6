#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/closure.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

/// A view at `angle` degrees to the normal z, turned by `azimuth` degrees; beyond
/// 90 from below.
Columns view(double angle, double azimuth = 30.0) {
  const double theta = angle * std::numbers::pi / 180.0;
  const double phi = azimuth * std::numbers::pi / 180.0;
  return {{"wo.x", {static_cast<float>(std::sin(theta) * std::cos(phi))}},
          {"wo.y", {static_cast<float>(std::sin(theta) * std::sin(phi))}},
          {"wo.z", {static_cast<float>(std::cos(theta))}},
          {"N.z", {1.0f}},
          {"T.x", {1.0f}}};
}

/// All light that a surface in a white world sends to the viewer: the mean weight
/// of samples on a grid of random numbers.
class Furnace {
 public:
  template <class F>
  explicit Furnace(F&& make, Bool thin_walled = false) {
    Recorder recorder;
    Surface surface;
    surface.bsdf = make(recorder);
    surface.thin_walled = thin_walled;
    const SurfaceKernels kernels = record_kernels(recorder, surface, Accuracy::standard, {});
    sample_ = make_reference(slice(recorder.program(), "sample", kernels.sample));
    albedo_ = make_reference(slice(recorder.program(), "albedo", kernels.albedo));
  }

  double light(double angle, int n = 48, int nz = 24, double azimuth = 30.0) const {
    Columns in = view(angle, azimuth);
    for (int i = 0; i < n * n * nz; ++i) {
      in["u.x"].push_back((static_cast<float>(i / nz / n) + 0.5f) / static_cast<float>(n));
      in["u.y"].push_back((static_cast<float>(i / nz % n) + 0.5f) / static_cast<float>(n));
      in["u.z"].push_back((static_cast<float>(i % nz) + 0.5f) / static_cast<float>(nz));
    }
    const auto out = run_double(*sample_, in);
    double sum = 0.0;
    for (const double weight : out.at("weight.x")) sum += weight;
    return sum / (n * n * nz);
  }

  double albedo(double angle) const { return run_double(*albedo_, view(angle)).at("albedo.x")[0]; }

 private:
  std::unique_ptr<ReferenceKernel> sample_, albedo_;
};

BsdfPtr white_metal(Recorder& recorder, Float ax, Float ay) {
  return microfacet_bsdf(
      recorder, "conductor_bsdf",
      {{"ior", colour(0.0f)}, {"extinction", colour(1.0f)}, {"roughness", roughness(ax, ay)}});
}

TEST(Furnace, WhiteMetalReturnsAllLight) {
  for (const float alpha : {0.05f, 0.1f, 0.2f, 0.5f, 0.8f, 1.0f}) {
    const Furnace furnace([&](Recorder& r) { return white_metal(r, alpha, alpha); });
    for (const double angle : {0.0, 30.0, 60.0, 75.0, 85.0}) {
      EXPECT_NEAR(furnace.light(angle, 96, 1), 1.0, 1e-2) << alpha << " " << angle;
      EXPECT_NEAR(furnace.albedo(angle), 1.0, 1e-6);
    }
  }
}

// The tables are isotropic; pbs/energy.h says how anisotropy looks them up.
TEST(Furnace, AnisotropicWhiteMetalReturnsMostLight) {
  const float pairs[][2] = {{0.5f, 0.1f}, {1.0f, 0.3f}, {0.2f, 0.05f}, {1.0f, 0.05f}};
  for (const auto& [ax, ay] : pairs) {
    const Furnace furnace([&](Recorder& r) { return white_metal(r, ax, ay); });
    for (const double azimuth : {0.0, 45.0, 90.0}) {
      for (const double angle : {0.0, 45.0, 75.0, 85.0}) {
        EXPECT_NEAR(furnace.light(angle, 96, 1, azimuth), 1.0, 7.5e-2)
            << ax << " " << ay << " angle " << angle << " azimuth " << azimuth;
      }
    }
  }
}

}  // namespace
}  // namespace nacre
