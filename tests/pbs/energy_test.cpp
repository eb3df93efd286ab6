#include "pbs/energy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

constexpr double pi_d = std::numbers::pi;

GgxView same(Float cosine, Float alpha) {
  return {.cosine = cosine, .masked = cosine, .alpha = alpha};
}

struct Lobe {
  double albedo, fresnel5;
};

/// The reflection lobe written as in Walter et al. 2007, eq. 20, 33 and 34 with
/// the height-correlated G, summed over facet slopes instead of visible normals.
Lobe reflection_by_slopes(double cosine, double alpha) {
  const int n = 700;
  const double sine = std::sqrt(1.0 - cosine * cosine);
  const auto lambda = [&](double z) {
    return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 - z * z) / (z * z)) - 1.0);
  };
  Lobe sum{0.0, 0.0};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double t = (i + 0.5) / n;
      const double r = t / (1.0 - t);
      const double phi = pi_d * (j + 0.5) / n;
      const double z = 1.0 / std::sqrt(1.0 + alpha * alpha * r * r);
      const double c = sine * alpha * r * std::cos(phi) * z + cosine * z;
      const double out = 2.0 * c * z - cosine;
      if (c <= 0.0 || out <= 0.0) continue;
      const double slopes = alpha * alpha * r * (1.0 + r) * (1.0 + r) * 2.0 * pi_d / (n * n);
      const double d = 1.0 / (pi_d * alpha * alpha * std::pow(z, 4) * std::pow(1.0 + r * r, 2));
      const double g = 1.0 / (1.0 + lambda(cosine) + lambda(out));
      const double light = d * g * c / cosine * slopes * z * z * z;
      sum.albedo += light;
      sum.fresnel5 += light * std::pow(1.0 - c, 5);
    }
  }
  return sum;
}

TEST(GgxTables, ReflectionIsTheIntegralOfTheLobe) {
  for (const float alpha : {0.01f, 0.05f, 0.12f, 0.33f, 0.7f, 1.0f}) {
    for (const float cosine : {0.05f, 0.2f, 0.6f, 1.0f}) {
      const auto out = evaluate({{"c", {cosine}}, {"a", {alpha}}}, [](Recorder& r) {
        const GgxReflection e = ggx_reflection(r, same(input(r, "c"), input(r, "a")));
        const auto schlick = [](Float c) { return square(square(1.0f - c)) * (1.0f - c); };
        return std::vector<SliceOutput>{{"e", e.albedo.ref()},
                                        {"b", (e.albedo * e.mean(schlick)).ref()}};
      });
      const Lobe expected = reflection_by_slopes(cosine, alpha);
      EXPECT_NEAR(out.at("e")[0], expected.albedo, 4e-3) << alpha << " " << cosine;
      EXPECT_NEAR(out.at("b")[0], expected.fresnel5, 4e-3) << alpha << " " << cosine;
    }
  }
}

TEST(GgxTables, LiteralCoordinatesFoldToTheSameValues) {
  for (const float alpha : {0.02f, 0.5f}) {
    const auto out = evaluate({{"c", {0.3f}}, {"a", {alpha}}, {"eta", {0.7f}}}, [&](Recorder& r) {
      const Float c = input(r, "c");
      const Float eta = input(r, "eta");
      return std::vector<SliceOutput>{
          {"varying", ggx_leaving(r, same(c, input(r, "a")), eta, 1.0f).transmission.ref()},
          {"folded", ggx_leaving(r, same(c, alpha), 0.7f, 1.0f).transmission.ref()}};
    });
    EXPECT_NEAR(out.at("varying")[0], out.at("folded")[0], 1e-6);
  }
}

}  // namespace
}  // namespace nacre
