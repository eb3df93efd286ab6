#include "pbs/energy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "pbs/fresnel.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

constexpr double pi_d = std::numbers::pi;

FacetView same(Float cosine, Float alpha, FacetDistribution of = FacetDistribution::ggx) {
  return {.distribution = of, .cosine = cosine, .masked = cosine, .alpha = alpha};
}

constexpr float indices[] = {1.05f, 1.1f, 1.2f, 1.33f, 1.5f, 2.5f};

struct Lobe {
  double albedo = 0.0, fresnel5 = 0.0;
  double dielectric[std::size(indices)] = {};  ///< With Fresnel's factor.
};

/// By the angle of refraction: Born and Wolf, "Principles of Optics", 1.5.2, eq. 21a.
double fresnel(double cosine, double index) {
  const double i = std::acos(std::clamp(cosine, 1e-9, 1.0 - 1e-9));
  const double t = std::asin(std::sin(i) / index);
  const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
  return 0.5 * (s * s + p * p);
}

struct Direction {
  double x, y, z;
};
Direction direction(double cosine, double azimuth) {
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

struct Roughness {
  double x, y;
};

/// The reflection lobe written as in Walter et al. 2007, eq. 20, 33 and 34 with
/// the height-correlated G, or eq. 25 for Beckmann's facets with Lambda by erf, summed over facet
/// slopes instead of visible normals. Of two roughnesses: Heitz, "Understanding the
/// Masking-Shadowing Function in Microfacet-Based BRDFs", 2014, eq. 80 to 86.
Lobe reflection_by_slopes(Direction wo, Roughness alpha, FacetDistribution of) {
  const int steps = 400, azimuths = 160;
  const bool is_ggx = of == FacetDistribution::ggx;
  const auto lambda = [&](const Direction& w) {
    const double steep = std::hypot(alpha.x * w.x, alpha.y * w.y) / w.z;
    if (!is_ggx) {
      const double a = 1.0 / std::max(steep, 1e-6);
      return 0.5 * (std::exp(-a * a) / (a * std::sqrt(pi_d)) - std::erfc(a));
    }
    return 0.5 * (std::sqrt(1.0 + steep * steep) - 1.0);
  };
  const double lambda_o = lambda(wo);
  Lobe sum;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < azimuths; ++j) {
      const double t = (i + 0.5) / steps;
      const double r = t / (1.0 - t);
      const double phi = 2.0 * pi_d * (j + 0.5) / azimuths;
      const double sx = alpha.x * r * std::cos(phi), sy = alpha.y * r * std::sin(phi);
      const double z = 1.0 / std::sqrt(1.0 + sx * sx + sy * sy);
      const double c = (wo.x * sx + wo.y * sy + wo.z) * z;
      const Direction out{2.0 * c * sx * z - wo.x, 2.0 * c * sy * z - wo.y, 2.0 * c * z - wo.z};
      if (c <= 0.0 || out.z <= 0.0) continue;
      const double area = alpha.x * alpha.y;
      const double share = 2.0 * pi_d / (steps * azimuths);
      const double slopes = area * r * (1.0 + r) * (1.0 + r) * share;
      const double tail = is_ggx ? std::pow(1.0 + r * r, 2) : std::exp(r * r);
      const double d = 1.0 / (pi_d * area * std::pow(z, 4) * tail);
      const double g = 1.0 / (1.0 + lambda_o + lambda(out));
      const double light = d * g * c / wo.z * slopes * z * z * z;
      sum.albedo += light;
      sum.fresnel5 += light * std::pow(1.0 - c, 5);
      for (std::size_t k = 0; k < std::size(indices); ++k) {
        sum.dielectric[k] += light * fresnel(c, double(indices[k]));
      }
    }
  }
  return sum;
}

TEST(FacetTables, ReflectionIsTheIntegralOfTheLobe) {
  for (const FacetDistribution of : {FacetDistribution::ggx, FacetDistribution::beckmann}) {
    for (const float alpha : {0.01f, 0.05f, 0.12f, 0.33f, 0.7f, 1.0f}) {
      for (const float cosine : {0.05f, 0.2f, 0.6f, 1.0f}) {
        const auto out = evaluate({{"c", {cosine}}, {"a", {alpha}}}, [&](Recorder& r) {
          const FacetView view = same(input(r, "c"), input(r, "a"), of);
          const FacetReflection e = facet_reflection(r, view);
          const auto schlick = [](Float c) { return square(square(1.0f - c)) * (1.0f - c); };
          std::vector<SliceOutput> outputs{{"e", e.albedo.ref()},
                                           {"b", (e.albedo * e.mean(schlick)).ref()}};
          for (const float index : indices) {
            const auto factor = [&](Float c) { return fresnel_dielectric(c, index); };
            const FacetReflection near = for_dielectric(r, view, e, steepness(index));
            outputs.push_back({std::to_string(index), (e.albedo * near.mean(factor)).ref()});
          }
          return outputs;
        });
        const Lobe expected = reflection_by_slopes(direction(cosine, 0.0), {alpha, alpha}, of);
        EXPECT_NEAR(out.at("e")[0], expected.albedo, 4e-3) << alpha << " " << cosine;
        EXPECT_NEAR(out.at("b")[0], expected.fresnel5, 4e-3) << alpha << " " << cosine;
        // Two cosines for all indices were 1.8 % of the light off at 1.1.
        for (std::size_t k = 0; k < std::size(indices); ++k) {
          EXPECT_NEAR(out.at(std::to_string(indices[k]))[0], expected.dielectric[k], 7e-3)
              << alpha << " " << cosine << " index " << indices[k];
        }
      }
    }
  }
}

// Along the wider roughness and across it, and where the view is turned against both.
TEST(FacetTables, UnequalReflectionIsTheIntegralOfTheLobe) {
  constexpr float usual[] = {1.33f, 1.5f, 2.5f};
  const float roughnesses[][2] = {{1, 0.1f},     {0.6f, 0.06f}, {0.5f, 0.25f},
                                  {0.3f, 0.21f}, {0.2f, 0.05f}, {0.07f, 0.02f}};
  for (const FacetDistribution of : {FacetDistribution::ggx, FacetDistribution::beckmann}) {
    for (const auto& [ax, ay] : roughnesses) {
      for (const double azimuth : {0.0, 0.5, 1.2, pi_d / 2}) {
        for (const double cosine : {0.05, 0.2, 0.6, 0.99}) {
          const Direction wo = direction(cosine, azimuth);
          const Columns view{{"x", {static_cast<float>(wo.x)}},
                             {"y", {static_cast<float>(wo.y)}},
                             {"z", {static_cast<float>(wo.z)}}};
          const auto out = evaluate(view, [&, x = ax, y = ay](Recorder& r) {
            const Float3 from{input(r, "x"), input(r, "y"), input(r, "z")};
            const FacetReflection e =
                facet_reflection(r, facet_view(from, of, {Float(x), Float(y)}, false));
            std::vector<SliceOutput> outputs{{"e", e.albedo.ref()}};
            for (const float index : usual) {
              const auto factor = [&](Float c) { return fresnel_dielectric(c, index); };
              outputs.push_back({std::to_string(index), (e.albedo * e.mean(factor)).ref()});
            }
            return outputs;
          });
          const Lobe expected = reflection_by_slopes(wo, {ax, ay}, of);
          const std::string place = std::to_string(ax) + ' ' + std::to_string(ay) + " azimuth " +
                                    std::to_string(azimuth) + " cosine " + std::to_string(cosine);
          EXPECT_NEAR(out.at("e")[0], expected.albedo, 1e-2) << place;
          for (std::size_t k = 0; k < std::size(usual); ++k) {
            const double light = expected.dielectric[k + 3];
            EXPECT_NEAR(out.at(std::to_string(usual[k]))[0], light, 1e-2)
                << place << " index " << usual[k];
          }
        }
      }
    }
  }
}

TEST(FacetTables, LiteralCoordinatesFoldToTheSameValues) {
  for (const float alpha : {0.02f, 0.5f}) {
    const auto out = evaluate({{"c", {0.3f}}, {"a", {alpha}}, {"eta", {0.7f}}}, [&](Recorder& r) {
      const Float c = input(r, "c");
      const Float eta = input(r, "eta");
      return std::vector<SliceOutput>{
          {"varying", facet_leaving(r, same(c, input(r, "a")), eta, 1.0f).transmission.ref()},
          {"folded", facet_leaving(r, same(c, alpha), 0.7f, 1.0f).transmission.ref()}};
    });
    EXPECT_NEAR(out.at("varying")[0], out.at("folded")[0], 1e-6);
  }
}

}  // namespace
}  // namespace nacre
