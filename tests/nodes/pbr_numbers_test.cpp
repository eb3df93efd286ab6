#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

#include "tests/nodes/node_runner.h"

namespace nacre {
namespace {

const NodeUnderTest artistic_ior{"artistic_ior",
                                 {{"reflectivity", Type::color3}, {"edge_color", Type::color3}},
                                 {{"ior", Type::color3}, {"extinction", Type::color3}}};

/// |(n + ik - 1) / (n + ik + 1)|^2: Fresnel at normal incidence.
double reflectance(double n, double k) {
  const std::complex<double> ior(n, k);
  return std::norm((ior - 1.0) / (ior + 1.0));
}

TEST(ArtisticIor, ReflectsWhatWasAskedFor) {
  std::vector<float> r;
  std::vector<float> g;
  for (const float reflectivity : {0.001f, 0.04f, 0.5f, 0.9f, 0.99f, 0.999f, 0.99999f}) {
    for (const float edge : {0.0f, 0.25f, 0.75f, 1.0f}) {
      r.push_back(reflectivity);
      g.push_back(edge);
    }
  }
  const DoubleColumns out = run_node(artistic_ior, {{"reflectivity.x", r}, {"edge_color.x", g}});
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double n = out.at("ior.x")[i];
    const double k = out.at("extinction.x")[i];
    EXPECT_NEAR(reflectance(n, k), std::fmin(r[i], 0.99999), 1e-7) << r[i] << ' ' << g[i];
  }
}

TEST(ArtisticIor, IsGulbrandsensFormulaInTheMiddle) {
  const DoubleColumns out =
      run_node(artistic_ior, {{"reflectivity.x", {0.6f}}, {"edge_color.x", {0.3f}}});
  const double r = 0.6f;
  const double g = 0.3f;
  const double n = g * (1 - r) / (1 + r) + (1 - g) * (1 + std::sqrt(r)) / (1 - std::sqrt(r));
  const double k = std::sqrt((r * (n + 1) * (n + 1) - (n - 1) * (n - 1)) / (1 - r));
  EXPECT_NEAR(out.at("ior.x")[0], n, 1e-12);
  EXPECT_NEAR(out.at("extinction.x")[0], k, 1e-12);
}

TEST(Roughness, AnisotropyTradesOneAlphaForTheOther) {
  const auto alphas = [](float roughness, float anisotropy) {
    return call_node(
        "roughness_anisotropy",
        {{"roughness", Type::float_, {roughness}}, {"anisotropy", Type::float_, {anisotropy}}},
        Type::vector2);
  };
  const std::vector<double> some = alphas(0.5f, 0.75f);
  EXPECT_NEAR(some[0], 0.5, 1e-12);
  EXPECT_NEAR(some[1], 0.125, 1e-12);
  EXPECT_EQ(alphas(0.5f, -1.0f), (std::vector<double>{0.25, 0.25}));
  EXPECT_NEAR(alphas(0.0f, 0.0f)[1], 1e-8, 1e-15);
  EXPECT_EQ(alphas(2.0f, 1.0f)[0], 1.0);
}

TEST(Roughness, ANegativeSecondOneIsTheFirst) {
  const auto alphas = [](float x, float y) {
    return call_node("roughness_dual", {{"roughness", Type::vector2, {x, y}}}, Type::vector2);
  };
  EXPECT_EQ(alphas(0.5f, -1.0f), (std::vector<double>{0.25, 0.25}));
  EXPECT_EQ(alphas(0.5f, 0.25f), (std::vector<double>{0.25, 0.0625}));
}

std::array<double, 3> blackbody(float kelvin) {
  const std::vector<double> rgb =
      call_node("blackbody", {{"temperature", Type::float_, {kelvin}}}, Type::color3);
  return {rgb[0], rgb[1], rgb[2]};
}

/// CIE xy of a linear Rec.709 colour (IEC 61966-2-1).
std::array<double, 2> chromaticity(const std::array<double, 3>& c) {
  const double x = 0.4123907993 * c[0] + 0.3575843394 * c[1] + 0.1804807884 * c[2];
  const double y = 0.2126390059 * c[0] + 0.7151686788 * c[1] + 0.0721923154 * c[2];
  const double z = 0.0193308187 * c[0] + 0.1191947798 * c[1] + 0.9505321522 * c[2];
  return {x / (x + y + z), y / (x + y + z)};
}

TEST(Blackbody, LiesOnThePlanckianLocus) {
  // CIE 1931 xy: standard illuminant A (2856 K at c2 of its definition), and the
  // locus at the colour temperatures of Wyszecki and Stiles, table 1(3.11).
  const std::array<std::array<double, 3>, 4> locus{{{2855.5, 0.4476, 0.4074},
                                                    {4000, 0.3805, 0.3768},
                                                    {6500, 0.3135, 0.3237},
                                                    {10000, 0.2807, 0.2884}}};
  for (const auto& [kelvin, x, y] : locus) {
    const std::array<double, 2> xy = chromaticity(blackbody(static_cast<float>(kelvin)));
    EXPECT_NEAR(xy[0], x, 2e-4) << kelvin;
    EXPECT_NEAR(xy[1], y, 2e-4) << kelvin;
  }
}

TEST(Blackbody, HasUnitLuminanceAndNoNegativeChannel) {
  for (const float kelvin : {0.0f, 500.0f, 800.0f, 1200.0f, 1900.0f, 5000.0f, 25000.0f, 1e8f}) {
    const std::array<double, 3> c = blackbody(kelvin);
    EXPECT_NEAR(0.2126390059 * c[0] + 0.7151686788 * c[1] + 0.0721923154 * c[2], 1.0, 1e-6);
    for (const double channel : c) EXPECT_GE(channel, 0.0) << kelvin;
  }
}

TEST(Blackbody, TableIsAsFineAsItSays) {
  // A quarter step against the quadratic through its neighbours tells the error of
  // interpolation from the second difference: h^2 f'' / 8.
  const double step = 1.25 / 512;
  double worst = 0.0;
  for (double s = 2 * step; s < 1.2; s += step) {
    const auto at = [&](double x) { return blackbody(static_cast<float>(1000.0 / x)); };
    const std::array<double, 3> a = at(s - step);
    const std::array<double, 3> b = at(s);
    const std::array<double, 3> c = at(s + step);
    for (std::size_t k = 0; k < 3; ++k) {
      if (a[k] == 0.0 || b[k] == 0.0 || c[k] == 0.0) continue;  // At the gamut's edge.
      worst = std::fmax(worst, std::fabs(a[k] - 2 * b[k] + c[k]) / 8);
    }
    s += 6 * step;
  }
  EXPECT_LT(worst, 4e-5);
}

TEST(Hair, MelaninOfOnePigmentAbsorbsItsColour) {
  // Concentration 1 - 1/e is melanin 1.
  const auto absorption = [](float redness) {
    return call_node("deon_hair_absorption_from_melanin",
                     {{"melanin_concentration", Type::float_, {0.63212056f}},
                      {"melanin_redness", Type::float_, {redness}},
                      {"eumelanin_color", Type::color3, {0.657704f, 0.498077f, 0.254107f}},
                      {"pheomelanin_color", Type::color3, {0.829444f, 0.67032f, 0.349938f}}},
                     Type::vector3);
  };
  // d'Eon et al. 2011: absorption of the pigments per unit of melanin.
  const std::array<double, 3> eumelanin{0.419, 0.697, 1.37};
  const std::array<double, 3> pheomelanin{0.187, 0.4, 1.05};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(absorption(0.0f)[k], eumelanin[k], 1e-5);
    EXPECT_NEAR(absorption(1.0f)[k], pheomelanin[k], 1e-5);
  }
}

TEST(Hair, AbsorptionFromColourInvertsChiangsFit) {
  const double beta = 0.3f;
  const std::vector<double> sigma = call_node(
      "chiang_hair_absorption_from_color",
      {{"color", Type::color3, {0.5f, 1.0f, 0.0f}}, {"azimuthal_roughness", Type::float_, {0.3f}}},
      Type::vector3);
  const double f = 5.969 - 0.215 * beta + 2.532 * std::pow(beta, 2) - 10.73 * std::pow(beta, 3) +
                   5.574 * std::pow(beta, 4) + 0.245 * std::pow(beta, 5);
  EXPECT_NEAR(sigma[0], std::pow(std::log(0.5) / f, 2), 1e-7);
  EXPECT_EQ(sigma[1], 0.0);
  EXPECT_NEAR(sigma[2], std::pow(std::log(0.001) / f, 2), 1e-5);
}

TEST(Hair, RoughnessFollowsChiangsFits) {
  const NodeUnderTest node{"chiang_hair_roughness",
                           {{"longitudinal"}, {"azimuthal"}, {"scale_TT"}, {"scale_TRT"}},
                           {{"roughness_R", Type::vector2},
                            {"roughness_TT", Type::vector2},
                            {"roughness_TRT", Type::vector2}}};
  const DoubleColumns out = run_node(node, {{"longitudinal", {0.8f}},
                                            {"azimuthal", {0.9f}},
                                            {"scale_TT", {0.5f}},
                                            {"scale_TRT", {2.0f}}});
  const double l = 0.8f;
  const double a = 0.9f;
  const double v = std::pow(0.726 * l + 0.812 * l * l + 3.7 * std::pow(l, 20), 2);
  const double s = 0.265 * a + 1.194 * a * a + 5.372 * std::pow(a, 22);
  EXPECT_NEAR(out.at("roughness_R.x")[0], v, 1e-6);
  EXPECT_NEAR(out.at("roughness_TT.x")[0], v / 4, 1e-6);
  EXPECT_NEAR(out.at("roughness_TRT.x")[0], v * 4, 1e-6);
  for (const char* name : {"roughness_R.y", "roughness_TT.y", "roughness_TRT.y"}) {
    EXPECT_NEAR(out.at(name)[0], s, 1e-6) << name;
  }
}

}  // namespace
}  // namespace nacre
