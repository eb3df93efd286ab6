// KernelRequest::compensation: what several scatterings between facets bring back, or not.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "tests/pbs/battery/lobe_kernels.h"
#include "tests/support/closure.h"

namespace nacre {
namespace {

/// GGX facets of one roughness, white.
struct Case {
  const char* category;
  const char* mode;
  float alpha;
};

BsdfPtr white(Recorder& recorder, const Case& row) {
  const Float alpha = row.alpha;
  return microfacet_bsdf(recorder, row.category,
                         {{"ior", std::string_view(row.mode).empty() ? colour(0.0f) : number(1.5f)},
                          {"extinction", colour(1.0f)},
                          {"scatter_mode", text(row.mode)},
                          {"roughness", roughness(alpha, alpha)}});
}

class Kernels {
 public:
  Kernels(const Case& row, Compensation compensation) {
    Recorder recorder;
    Surface surface;
    surface.bsdf = white(recorder, row);
    KernelRequest request;
    request.compensation = compensation;
    const SurfaceKernels kernels = record_kernels(recorder, surface, Accuracy::standard, request);
    const auto made = [&](const char* name, const std::vector<SliceOutput>& outputs) {
      return lobe_kernel(slice(recorder.program(), name, outputs), Accuracy::standard);
    };
    sample_ = made("sample", kernels.sample);
    evaluate_ = made("evaluate", kernels.evaluate);
  }

  /// What a white world sends to a view: the mean weight of samples.
  double light(double angle) const {
    constexpr std::size_t count = 1 << 16;
    Columns in = view(angle);
    set_random(in, count, 5);
    double sum = 0.0;
    const Columns out = run(*sample_, in);
    for (const float weight : out.at("weight.x")) sum += weight;
    return sum / count;
  }

  std::vector<float> f(double angle, const std::vector<Direction>& wi) const {
    Columns in = view(angle);
    set_directions(in, "wi", wi);
    return run(*evaluate_, in).at("f.x");
  }

 private:
  static Columns view(double angle) {
    const double theta = angle * std::numbers::pi / 180.0;
    return {{"wo.x", {static_cast<float>(std::sin(theta))}},
            {"wo.z", {static_cast<float>(std::cos(theta))}},
            {"N.z", {1.0f}},
            {"Ng.z", {1.0f}},
            {"T.x", {1.0f}}};
  }

  std::shared_ptr<const Kernel> sample_, evaluate_;
};

std::vector<Direction> all_around() {
  std::vector<Direction> wi;
  for (int i = 0; i < 400; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 400.0, phi = 2.399963 * i, r = std::sqrt(1.0 - z * z);
    wi.push_back({static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                  static_cast<float>(z)});
  }
  return wi;
}

/// The light that white GGX facets reflect once to a view, in double: the mean of G2 / G1 over the
/// normals that are seen. Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4),
/// 2018; Smith's correlated masking, Heitz, JCGT 3(2), 2014, eq. 99.
double reflected_once(double angle, double alpha) {
  const double theta = angle * std::numbers::pi / 180.0;
  const double x = std::sin(theta), z = std::cos(theta);
  const auto lambda = [&](double cosine) {
    const double tan2 = (1.0 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * tan2) - 1.0);
  };
  const double norm = std::hypot(alpha * x, z), vx = alpha * x / norm, vz = z / norm;
  constexpr int n = 1000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double r = std::sqrt((i + 0.5) / n), phi = 2.0 * std::numbers::pi * (j + 0.5) / n;
      const double t1 = r * std::cos(phi), s = 0.5 * (1.0 + vz);
      const double t2 =
          (1.0 - s) * std::sqrt(1.0 - t1 * t1) + s * r * std::sin(phi);  // along V x T1
      const double t3 = std::sqrt(std::max(0.0, 1.0 - t1 * t1 - t2 * t2));
      // T1 is across the plane of the view, V x T1 = (-vz, 0, vx).
      const double hx = alpha * (-vz * t2 + vx * t3), hy = alpha * t1;
      const double hz = std::max(0.0, vx * t2 + vz * t3);
      const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
      const double d = (x * hx + z * hz) / length;
      const double wz = 2.0 * d * hz / length - z;
      if (wz <= 0.0) continue;
      sum += (1.0 + lambda(z)) / (1.0 + lambda(z) + lambda(wz));
    }
  }
  return sum / (double{n} * n);
}

TEST(Compensation, WithoutItWhiteMetalReflectsOnce) {
  for (const float alpha : {0.1f, 0.5f, 1.0f}) {
    const Kernels metal({"conductor_bsdf", "", alpha}, Compensation::nothing);
    for (const double angle : {5.0, 45.0, 75.0, 85.0}) {
      EXPECT_NEAR(metal.light(angle), reflected_once(angle, alpha), 3e-3) << alpha << ' ' << angle;
    }
  }
}

TEST(Compensation, IsAFactorOfTheView) {
  const std::vector<Direction> wi = all_around();
  const Case rows[] = {{"conductor_bsdf", "", 0.6f},
                       {"dielectric_bsdf", "R", 0.6f},
                       {"dielectric_bsdf", "T", 0.6f},
                       {"dielectric_bsdf", "RT", 0.6f}};
  for (const Case& row : rows) {
    const Kernels all(row, Compensation::all), nothing(row, Compensation::nothing);
    for (const double angle : {30.0, 80.0}) {
      const std::vector<float> with = all.f(angle, wi), without = nothing.f(angle, wi);
      std::optional<double> factor;
      for (std::size_t i = 0; i < wi.size(); ++i) {
        if (without[i] < 1e-4f) continue;
        const double ratio = with[i] / without[i];
        if (!factor) factor = ratio;
        EXPECT_GE(ratio, 1.0 - 1e-5) << row.category << row.mode;
        EXPECT_NEAR(ratio, *factor, 1e-4 * *factor) << row.category << row.mode << ' ' << angle;
      }
      EXPECT_TRUE(factor.has_value()) << row.category << row.mode;
    }
  }
}

TEST(Compensation, OfReflectionLeavesRoughGlassDarker) {
  const std::vector<Direction> wi = all_around();
  const Case metal{"conductor_bsdf", "", 0.8f}, glass{"dielectric_bsdf", "RT", 0.8f};
  const Kernels bright(glass, Compensation::all), dark(glass, Compensation::reflection);
  EXPECT_EQ(Kernels(metal, Compensation::reflection).f(50.0, wi),
            Kernels(metal, Compensation::all).f(50.0, wi));
  EXPECT_EQ(dark.f(50.0, wi), Kernels(glass, Compensation::nothing).f(50.0, wi));
  EXPECT_NEAR(bright.light(50.0), 1.0, 1e-2);
  EXPECT_LT(dark.light(50.0), 0.95);
}

}  // namespace
}  // namespace nacre
