#include "pbs/beckmann.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

constexpr double pi_d = std::numbers::pi;

Float3 input3(Recorder& r, const std::string& name) {
  return {input(r, name + ".x"), input(r, name + ".y"), input(r, name + ".z")};
}

/// The density of slopes by its definition: two normal distributions of variance alpha^2 / 2.
double of_slopes(double x, double y, double ax, double ay) {
  return std::exp(-(x * x / (ax * ax) + y * y / (ay * ay))) / (pi_d * ax * ay);
}

TEST(Beckmann, TheDensityOfNormalsIsThatOfSlopes) {
  const float pairs[][2] = {{1e-4f, 1e-4f}, {0.02f, 0.02f}, {0.5f, 0.5f}, {1.0f, 0.1f}};
  for (const auto& [ax, ay] : pairs) {
    for (const double share : {0.0, 0.5, 1.0, 2.0}) {
      const double x = share * ax, y = -0.7 * share * ay;
      const double z = 1.0 / std::sqrt(1.0 + x * x + y * y);
      // Of no unit length.
      const auto d = evaluate(
          {{"h.x", {static_cast<float>(-x)}}, {"h.y", {static_cast<float>(-y)}}, {"h.z", {1.0f}}},
          [&](Recorder& r) {
            return std::vector<SliceOutput>{
                {"d", beckmann_distribution(input3(r, "h"), {ax, ay}).ref()}};
          });
      const double expected = of_slopes(x, y, ax, ay) / (z * z * z * z);
      EXPECT_NEAR(d.at("d")[0] / expected, 1.0, 1e-5) << ax << " " << ay << " " << share;
    }
  }
}

TEST(Beckmann, NormalsAlongTheSurfaceHaveNoDensity) {
  const auto d =
      evaluate({{"h.x", {1.0f, 0.0f}}, {"h.y", {0.0f}}, {"h.z", {0.0f, 0.0f}}}, [&](Recorder& r) {
        return std::vector<SliceOutput>{
            {"d", beckmann_distribution(input3(r, "h"), {1.0f, 1.0f}).ref()}};
      });
  EXPECT_EQ(d.at("d")[0], 0.0);
  EXPECT_TRUE(std::isfinite(d.at("d")[1]));
}

/// Heitz 2014, eq. 14: what facets project onto a view is G1's inverse of it, by quadrature over
/// slopes.
TEST(Beckmann, MaskingIsWhatFacetsProject) {
  for (const double alpha : {0.05, 0.4, 1.0}) {
    for (const double angle : {0.0, 30.0, 60.0, 80.0, 89.0, 89.9}) {
      const double theta = angle * pi_d / 180.0;
      const double c = std::cos(theta), s = std::sin(theta);
      double projected = 0.0;
      const int n = 20000;
      for (int i = 0; i < n; ++i) {
        const double x = 12.0 * ((i + 0.5) / n - 0.5);  // Slope over alpha, along the view.
        projected += std::exp(-x * x) / std::sqrt(pi_d) * std::max(c - alpha * x * s, 0.0) * 12 / n;
      }
      const auto out = evaluate(
          {{"x", {static_cast<float>(s)}}, {"z", {static_cast<float>(c)}}}, [&](Recorder& r) {
            const Float3 w{input(r, "x"), 0.0f, input(r, "z")};
            const Float a = static_cast<float>(alpha);
            return std::vector<SliceOutput>{{"root", beckmann_root(w, {a, a}).ref()}};
          });
      // G1 = 2 z / (z + root) = z / projected.
      EXPECT_NEAR(0.5 * (c + out.at("root")[0]) / projected, 1.0, 2e-6) << alpha << " " << angle;
    }
  }
}

/// The slopes of sampled normals, along the view and across it, against the distribution of those
/// that are seen: at each share of the random numbers the integral up to the slope is that share.
TEST(Beckmann, SampledNormalsFollowTheirDensity) {
  for (const double alpha : {0.05, 0.5, 1.0}) {
    for (const double angle : {0.0, 10.0, 40.0, 80.0, 89.0, 89.99}) {
      const double theta = angle * pi_d / 180.0;
      const double stretched = std::hypot(alpha * std::sin(theta), std::cos(theta));
      const double s = alpha * std::sin(theta) / stretched;
      const double c = std::cos(theta) / stretched;
      Columns u;
      for (int i = 0; i < 200; ++i) {
        u["u"].push_back((static_cast<float>(i) + 0.5f) / 200.0f);
        u["v"].push_back((static_cast<float>((i * 89) % 200) + 0.5f) / 200.0f);
      }
      // And the ends, up to where facets are left out.
      for (const float end : {3e-5f, 1e-4f, 1e-3f}) {
        for (const float number : {end, 1.0f - end}) {
          u["u"].push_back(number);
          u["v"].push_back(number);
        }
      }
      const Float3 wo{0.6f * static_cast<float>(std::sin(theta)),
                      0.8f * static_cast<float>(std::sin(theta)),
                      static_cast<float>(std::cos(theta))};
      const Float a = static_cast<float>(alpha);
      const auto h = evaluate(u, [&](Recorder& r) {
        const Float3 n = sample_visible_beckmann(wo, {a, a}, input(r, "u"), input(r, "v"));
        return std::vector<SliceOutput>{{"x", n.x.ref()}, {"y", n.y.ref()}, {"z", n.z.ref()}};
      });
      const auto below = [&](double x) {
        return c * std::sqrt(pi_d) * (1.0 + std::erf(x)) + s * std::exp(-x * x);
      };
      for (std::size_t i = 0; i < u.at("u").size(); ++i) {
        const double x = -h.at("x")[i] / h.at("z")[i] / alpha;
        const double y = -h.at("y")[i] / h.at("z")[i] / alpha;
        // At normal incidence any direction is along the view: it is x.
        const double along = angle == 0.0 ? x : 0.6 * x + 0.8 * y;
        const double across = angle == 0.0 ? y : -0.8 * x + 0.6 * y;
        const double top = s > 0.0 ? c / s : 1e9;
        EXPECT_NEAR(below(along) / below(top), u.at("u")[i], 4e-6) << alpha << " " << angle;
        EXPECT_NEAR(0.5 * (1.0 + std::erf(across)), u.at("v")[i], 4e-6) << alpha << " " << angle;
      }
    }
  }
}

}  // namespace
}  // namespace nacre
