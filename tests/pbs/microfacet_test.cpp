#include "pbs/microfacet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pbs/sampling.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

constexpr double pi_d = std::numbers::pi;

std::vector<SliceOutput> store3(const char* name, Float3 v) {
  const std::string n(name);
  return {{n + ".x", v.x.ref()}, {n + ".y", v.y.ref()}, {n + ".z", v.z.ref()}};
}

Float3 input3(Recorder& r, const std::string& name) {
  return {input(r, name + ".x"), input(r, name + ".y"), input(r, name + ".z")};
}

/// Normals over the hemisphere, dense where the slope is of the order of alpha,
/// with the solid angle each stands for: slope = alpha tan(angle), exactly.
struct Normals {
  Columns h;
  std::vector<double> solid_angle;
  Normals(double ax, double ay, int n) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double t = (i + 0.5) / n;  // r / (1 + r), r the length of slope / alpha.
        const double r = t / (1.0 - t);
        const double phi = 2.0 * pi_d * (j + 0.5) / n;
        const double sx = ax * r * std::cos(phi);
        const double sy = ay * r * std::sin(phi);
        const double z = 1.0 / std::sqrt(1.0 + sx * sx + sy * sy);
        h["h.x"].push_back(static_cast<float>(-sx * z));
        h["h.y"].push_back(static_cast<float>(-sy * z));
        h["h.z"].push_back(static_cast<float>(z));
        const double slopes = ax * ay * r * (1.0 + r) * (1.0 + r) * 2.0 * pi_d / (n * n);
        solid_angle.push_back(slopes * z * z * z);
      }
    }
  }
};

std::vector<double> distribution(const Columns& h, float ax, float ay) {
  return evaluate(h,
                  [&](Recorder& r) {
                    return std::vector<SliceOutput>{
                        {"d", ggx_distribution(input3(r, "h"), {ax, ay}).ref()}};
                  })
      .at("d");
}

TEST(Ggx, NormalsCoverTheSurfaceOnce) {
  const float pairs[][2] = {{1e-3f, 1e-3f}, {0.01f, 0.01f}, {0.1f, 0.1f}, {0.4f, 0.4f},
                            {1.0f, 1.0f},   {0.3f, 0.02f},  {1.0f, 1e-3f}};
  for (const auto& [ax, ay] : pairs) {
    const Normals normals(ax, ay, 400);
    const auto d = distribution(normals.h, ax, ay);
    double sum = 0.0;
    for (std::size_t i = 0; i < d.size(); ++i) {
      sum += d[i] * normals.h.at("h.z")[i] * normals.solid_angle[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-3) << ax << " " << ay;
  }
}

/// Heitz 2014, eq. 14: the visible normals' projected area is the view's.
TEST(Ggx, MaskingMakesVisibleNormalsADensity) {
  for (const float alpha : {0.02f, 0.3f, 1.0f}) {
    for (const double angle : {0.0, 45.0, 80.0, 89.0}) {
      const double theta = angle * pi_d / 180.0;
      const double phi = 0.7;
      const Float3 wo{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                      std::cos(theta)};
      const Float2 both{alpha, 0.5f * alpha};
      const Normals normals(alpha, 0.5 * alpha, 500);
      const auto out = evaluate(normals.h, [&](Recorder& r) {
        const Float3 h = input3(r, "h");
        const Float seen = max(dot(h, wo), 0.0f);
        return std::vector<SliceOutput>{
            {"p", (ggx_distribution(h, both) * ggx_masking(wo, both) * seen / wo.z).ref()}};
      });
      double sum = 0.0;
      for (std::size_t i = 0; i < normals.solid_angle.size(); ++i) {
        sum += out.at("p")[i] * normals.solid_angle[i];
      }
      EXPECT_NEAR(sum, 1.0, 3e-3) << alpha << " " << angle;
    }
  }
}

/// Means of the slopes of sampled normals against the integral over the density.
TEST(Ggx, SampledNormalsFollowTheirDensity) {
  const int n = 300;
  Columns u;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      u["u"].push_back((static_cast<float>(i) + 0.5f) / n);
      u["v"].push_back((static_cast<float>(j) + 0.5f) / n);
    }
  }
  for (const float alpha : {0.05f, 0.5f, 1.0f}) {
    for (const double angle : {0.0, 40.0, 80.0}) {
      const double theta = angle * pi_d / 180.0;
      const Float3 wo{std::sin(theta) * 0.8, std::sin(theta) * 0.6, std::cos(theta)};
      const Float2 both{alpha, 0.6f * alpha};
      const auto h = evaluate(u, [&](Recorder& r) {
        return store3(
            "h", sample_visible_normal(wo, both, ggx_root(wo, both), input(r, "u"), input(r, "v")));
      });
      const Normals normals(alpha, 0.6 * alpha, 500);
      const auto p = evaluate(normals.h, [&](Recorder& r) {
        const Float3 m = input3(r, "h");
        return std::vector<SliceOutput>{
            {"p", (ggx_distribution(m, both) * ggx_masking(wo, both) * max(dot(m, wo), 0.0f) / wo.z)
                      .ref()}};
      });
      double sampled[3] = {0, 0, 0};
      double expected[3] = {0, 0, 0};
      const char* names[] = {"h.x", "h.y", "h.z"};
      for (int k = 0; k < 3; ++k) {
        for (const double x : h.at(names[k])) sampled[k] += x * x * x / (n * n);
        for (std::size_t i = 0; i < normals.solid_angle.size(); ++i) {
          expected[k] +=
              std::pow(normals.h.at(names[k])[i], 3) * p.at("p")[i] * normals.solid_angle[i];
        }
        EXPECT_NEAR(sampled[k], expected[k], 3e-3) << alpha << " " << angle << " " << k;
      }
    }
  }
}

TEST(Sampling, GoesRoundTheCircle) {
  Columns in;
  for (int i = -100'000; i <= 200'000; ++i) {
    in["share"].push_back(static_cast<float>(i) / 100'000.0f);
  }
  const auto out = evaluate(in, [](Recorder& r) {
    const Float2 on = on_circle(input(r, "share"));
    return std::vector<SliceOutput>{{"x", on.x.ref()}, {"y", on.y.ref()}};
  });
  for (std::size_t i = 0; i < in["share"].size(); ++i) {
    const double angle = 2.0 * pi_d * double(in["share"][i]);
    ASSERT_NEAR(out.at("x")[i], std::cos(angle), 2.5e-7) << in["share"][i];
    ASSERT_NEAR(out.at("y")[i], std::sin(angle), 2.5e-7) << in["share"][i];
  }
}

TEST(Ggx, BoundedSamplingWastesLess) {
  const int n = 200;
  Columns u;
  for (int i = 0; i < n * n; ++i) {
    u["u"].push_back((static_cast<float>(i / n) + 0.5f) / n);
    u["v"].push_back((static_cast<float>(i % n) + 0.5f) / n);
  }
  const auto below = [&](float alpha, double cosine, bool bounded) {
    const Float3 wo{std::sqrt(1.0 - cosine * cosine), 0.0f, cosine};
    const auto out = evaluate(u, [&](Recorder& r) {
      const Float bound = bounded ? reflection_bound(wo, {alpha, alpha}) : Float(1.0f);
      const Float3 h = sample_reflecting_normal(wo, {alpha, alpha}, ggx_root(wo, {alpha, alpha}),
                                                bound, input(r, "u"), input(r, "v"));
      return store3("wi", reflect_about(wo, h));
    });
    int count = 0;
    for (const double z : out.at("wi.z")) count += z <= 0.0;
    return count / double(n * n);
  };
  EXPECT_NEAR(below(1.0f, 1.0, false), 0.5, 1e-2);
  EXPECT_LE(below(1.0f, 1.0, true), 1e-6);
  EXPECT_LT(below(0.5f, 0.5, true), 0.5 * below(0.5f, 0.5, false));
}

TEST(Ggx, StableFarBelowTheThreshold) {
  // The closed form at h = z is 1 / (pi alpha^2); at slope alpha a quarter of it.
  for (const float alpha : {1e-4f, 1e-3f, 0.1f}) {
    const double peak = 1.0 / (pi_d * double(alpha) * alpha);
    const auto d =
        distribution({{"h.x", {0.0f, alpha}}, {"h.y", {0.0f}}, {"h.z", {1.0f}}}, alpha, alpha);
    EXPECT_NEAR(d[0] / peak, 1.0, 1e-6);
    const double z4 = std::pow(1.0 + double(alpha) * alpha, 2);
    EXPECT_NEAR(d[1] / peak, 0.25 * z4, 1e-6);
  }
}

}  // namespace
}  // namespace nacre
