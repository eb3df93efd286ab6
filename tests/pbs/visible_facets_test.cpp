#include "pbs/visible_facets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbs/estimate.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180;

TEST(Estimates, AreAsNearAsTheySay) {
  std::vector<float> numbers{1e-37f, 1e37f};
  for (int k = -110; k < 110; ++k) {
    for (int i = 0; i < 300; ++i) {
      numbers.push_back(std::ldexp(1.0f + static_cast<float>(i) / 300.0f, k));
    }
  }
  const auto out = evaluate({{"x", numbers}}, [](Recorder& r) {
    const Float x = input(r, "x");
    return std::vector<SliceOutput>{{"inverse_root", estimated_inverse_root(x).ref()},
                                    {"root", estimated_root(x).ref()},
                                    {"inverse", estimated_inverse(x).ref()}};
  });
  double inverse_root = 0.0, root = 0.0, inverse = 0.0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double x = numbers[k];
    const auto worse = [&](double& worst, const char* of, double expected) {
      worst = std::max(worst, std::abs(out.at(of)[k] / expected - 1.0));
    };
    worse(inverse_root, "inverse_root", 1.0 / std::sqrt(x));
    worse(root, "root", std::sqrt(x));
    worse(inverse, "inverse", 1.0 / x);
  }
  EXPECT_LE(inverse_root, 9e-4);
  EXPECT_LE(root, 9e-4);
  EXPECT_LE(inverse, 4e-6);
  const auto none = evaluate({{"x", {0.0f}}}, [](Recorder& r) {
    return std::vector<SliceOutput>{{"root", estimated_root(input(r, "x")).ref()}};
  });
  EXPECT_EQ(none.at("root")[0], 0.0);
}

struct Trial {
  float x, y;  ///< Roughness.
  double angle, azimuth;
};

/// What part of all the facets that a view sees the sum is of.
double share_of(FacetDistribution of, const Trial& trial, float eta) {
  const double sine = std::sin(trial.angle * degree);
  const Columns view{{"x", {static_cast<float>(sine * std::cos(trial.azimuth * degree))}},
                     {"y", {static_cast<float>(sine * std::sin(trial.azimuth * degree))}},
                     {"z", {static_cast<float>(std::cos(trial.angle * degree))}}};
  const auto out = evaluate(view, [&](Recorder& r) {
    const Facets facets{.distribution = of,
                        .alpha = {trial.x, trial.y},
                        .delta = false,
                        .threshold = 1e-4f,
                        .isotropic = false,
                        .normal = {0.0f, 0.0f, 1.0f},
                        .tangent = {1.0f, 0.0f, 0.0f},
                        .has_tangent = true};
    const Float3 wo{input(r, "x"), input(r, "y"), input(r, "z")};
    const Float share =
        VisibleFacets(wo, facets, eta)
            .sum(r, {34, 55}, true, Float(0.0f),
                 [](const VisibleFacet& facet, Float& sum) { sum = sum + facet.share; });
    return std::vector<SliceOutput>{{"share", share.ref()}};
  });
  return out.at("share")[0];
}

// Whatever the view: what it sees is all there is to see.
TEST(VisibleFacets, AreAllWhereLightEnters) {
  for (const auto& [x, y] : {std::pair{1.0f, 1.0f},
                             {1.0f, 0.1f},
                             {0.5f, 0.25f},
                             {0.02f, 0.9f},
                             {0.1f, 0.1f},
                             {0.01f, 0.03f},
                             {1e-4f, 0.6f}}) {
    for (const double angle : {0.0, 20.0, 45.0, 70.0, 85.0, 89.0, 89.9}) {
      for (const double azimuth : {0.0, 17.0, 45.0, 90.0, 200.0}) {
        EXPECT_NEAR(share_of(FacetDistribution::ggx, {x, y, angle, azimuth}, 1.5f), 1.0, 2e-3)
            << x << ' ' << y << ' ' << angle << ' ' << azimuth;
        EXPECT_NEAR(share_of(FacetDistribution::beckmann, {x, y, angle, azimuth}, 1.5f), 1.0, 2e-3)
            << x << ' ' << y << ' ' << angle << ' ' << azimuth;
      }
    }
  }
}

// From above the view sees facets by what they cover of the surface: slopes within a circle, whose
// integral over both distributions is known. Walter et al. 2007, eq. 25 and 33; of unequal
// roughness over the circle's angles by the integral of 1 / (p cos^2 + q sin^2).
TEST(VisibleFacets, AreThoseThatLetLightPassWhereItLeaves) {
  for (const float eta : {0.999f, 0.99f, 0.95f, 1 / 1.33f, 1 / 1.5f, 1 / 2.5f, 0.1f}) {
    const double n = eta;
    const double slope2 = 1.0 / (1.0 - n * n) - 1.0;  // Where total reflection begins.
    for (const auto& [x, y] : {std::pair{1.0f, 1.0f},
                               {1.0f, 0.1f},
                               {0.5f, 0.25f},
                               {0.02f, 0.9f},
                               {0.1f, 0.1f},
                               {0.01f, 0.03f}}) {
      const double x2 = double{x} * x, y2 = double{y} * y;
      EXPECT_NEAR(share_of(FacetDistribution::ggx, {x, y, 0.0, 0.0}, eta),
                  slope2 / std::sqrt((x2 + slope2) * (y2 + slope2)), 4e-3)
          << x << ' ' << y << " index " << eta;
      if (x != y) continue;
      EXPECT_NEAR(share_of(FacetDistribution::beckmann, {x, y, 0.0, 0.0}, eta),
                  1.0 - std::exp(-slope2 / x2), 4e-3)
          << x << " index " << eta;
    }
  }
}

}  // namespace
}  // namespace nacre
