// Dielectrics within others: the channel exterior_index.
#include "pbs/exterior.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include "tests/jit/shading/own_library.h"

namespace nacre {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Born and Wolf, "Principles of Optics", 1.5.2, eq. 36: unpolarised light at normal incidence.
double normal_reflectance(double n1, double n2) { return std::pow((n1 - n2) / (n1 + n2), 2.0); }

class Exterior : public OwnLibrary {
 protected:
  static std::string dielectric(const std::string& ior, const std::string& mode,
                                const std::string& more = "") {
    return node("dielectric_bsdf", "BSDF", "b",
                value_of("ior", "float", ior) + value_of("scatter_mode", "string", mode) +
                    (more.empty() ? value_of("roughness", "vector2", "0, 0") : more));
  }
  std::unique_ptr<MaterialKernels> within(const std::string& nodes) {
    options_.varying = {"exterior_index"};
    options_.kernels.entries |= entry_interior;
    return checked(nodes);
  }
  std::unique_ptr<MaterialKernels> in_vacuum(const std::string& nodes) {
    options_.varying.clear();
    return checked(nodes);
  }
  /// A sample of light at that angle to the normal, from outside or inside.
  static Numbers sample(const MaterialKernels& kernels, float exterior, double degrees, bool inside,
                        std::array<float, 3> u) {
    Numbers point{{"wo.x", static_cast<float>(std::sin(degrees * degree))},
                  {"wo.z", static_cast<float>((inside ? -1 : 1) * std::cos(degrees * degree))},
                  {"exterior_index", exterior}};
    const Numbers state = run(*kernels.begin, point);
    point.insert(state.begin(), state.end());
    point["u.x"] = u[0], point["u.y"] = u[1], point["u.z"] = u[2];
    return run(*kernels.sample, point);
  }
  static bool reads(const std::optional<BoundKernel>& kernel) {
    return kernel && std::ranges::find(kernel->program().inputs, exterior_index_channel,
                                       &Channel::name) != kernel->program().inputs.end();
  }

 private:
  std::unique_ptr<MaterialKernels> checked(const std::string& nodes) {
    auto kernels = material(nodes);
    EXPECT_NE(kernels, nullptr) << diagnostics_.to_string();
    return kernels;
  }
};

// Ice in water, glass in water, a bubble in glass.
TEST_F(Exterior, ReflectsWhatTheTwoIndicesSay) {
  for (const auto& [n2, n1] : {std::pair{"1.31", 1.333}, {"1.5", 1.333}, {"1", 1.52}}) {
    const auto kernels = within(dielectric(n2, "RT"));
    const double expected = normal_reflectance(n1, std::stod(n2));
    for (const bool inside : {false, true}) {
      // The first numbers reflect.
      const Numbers back = sample(*kernels, static_cast<float>(n1), 0, inside, {0.5f, 0.5f, 0});
      EXPECT_NEAR(back.at("pdf"), expected, 1e-4 * expected + 1e-8) << n2;
      EXPECT_GT(back.at("wi.z") * (inside ? -1 : 1), 0.99f);
      const Numbers forth = sample(*kernels, static_cast<float>(n1), 0, inside, {0.5f, 0.5f, 0.9f});
      EXPECT_NEAR(forth.at("pdf"), 1 - expected, 1e-5) << n2;
      EXPECT_NEAR(forth.at("weight.x"), 1, 1e-5) << n2;
    }
  }
}

// Snell's law, both ways, and where nothing leaves any more.
TEST_F(Exterior, BendsByTheRatio) {
  const auto kernels = within(dielectric("1.5", "RT"));
  constexpr double water = 1.333, glass = 1.5;
  for (const double degrees : {10.0, 40.0, 60.0}) {
    for (const bool inside : {false, true}) {
      const Numbers out =
          sample(*kernels, static_cast<float>(water), degrees, inside, {0.5f, 0.5f, 0.99f});
      const double ratio = inside ? glass / water : water / glass;
      EXPECT_NEAR(out.at("wi.x"), -ratio * std::sin(degrees * degree), 2e-6);
      EXPECT_GT(out.at("wi.z") * (inside ? 1 : -1), 0.0f);
    }
  }
  const double critical = std::asin(water / glass) / degree;  // 62.7; against vacuum 41.8.
  for (const double beside : {-0.1, 0.1}) {
    const Numbers out =
        sample(*kernels, static_cast<float>(water), critical + beside, true, {0.5f, 0.5f, 0.9999f});
    EXPECT_EQ(out.at("wi.z") > 0, beside < 0) << beside;
  }
}

TEST_F(Exterior, IsNotSeenInItsLike) {
  for (const char* alpha : {"0, 0", "0.3, 0.3"}) {
    const auto kernels = within(dielectric("1.4", "RT", value_of("roughness", "vector2", alpha)));
    for (const float u : {0.0f, 0.3f, 0.999f}) {
      const Numbers out = sample(*kernels, 1.4f, 50, false, {0.2f, 0.7f, u});
      EXPECT_NEAR(out.at("wi.x"), -std::sin(50 * degree), 2e-6) << alpha;
      EXPECT_LT(out.at("wi.z"), 0.0f);
      EXPECT_NEAR(out.at("weight.x"), 1, 1e-6);
      EXPECT_NEAR(out.at("pdf"), 1, 1e-6);
    }
  }
}

// White furnace: of rough glass in water nothing is lost, in front and behind.
TEST_F(Exterior, RoughGlassLosesNothing) {
  for (const char* alpha : {"0.1, 0.1", "0.5, 0.5"}) {
    const auto kernels = within(dielectric("1.5", "RT", value_of("roughness", "vector2", alpha)));
    for (const bool inside : {false, true}) {
      double mean = 0;
      std::mt19937 random(3);
      const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
      constexpr int count = 3000;
      for (int i = 0; i < count; ++i) {
        const Numbers out = sample(*kernels, 1.333f, 35, inside, {uniform(), uniform(), uniform()});
        mean += static_cast<double>(out.at("weight.x")) / count;
      }
      EXPECT_NEAR(mean, 1, 0.02) << alpha << inside;
    }
  }
}

// A film of the liquid around it is none, whatever its thickness.
TEST_F(Exterior, FilmsAreBetweenTheTwo) {
  const auto film = [](const std::string& thickness) {
    return dielectric("1.6", "R",
                      value_of("roughness", "vector2", "0, 0") +
                          value_of("thinfilm_thickness", "float", thickness) +
                          value_of("thinfilm_ior", "float", "1.333"));
  };
  for (const char* thickness : {"150", "600"}) {
    const auto kernels = within(film(thickness));
    Numbers point{{"wo.z", 1.0f}, {"exterior_index", 1.333f}};
    const Numbers albedo = run(*kernels->albedo, point);
    EXPECT_NEAR(albedo.at("albedo.y"), normal_reflectance(1.333, 1.6), 2e-4) << thickness;
    point["exterior_index"] = 1.0f;
    EXPECT_GT(std::abs(run(*kernels->albedo, point).at("albedo.y") - normal_reflectance(1.0, 1.6)),
              5e-3);
  }
}

TEST_F(Exterior, InteriorIsOverWhatIsOutside) {
  const auto kernels = within(dielectric("1.5", "RT"));
  ASSERT_TRUE(kernels->interior);
  const Numbers inside = run(*kernels->interior, {{"wo.z", 1.0f}, {"exterior_index", 1.25f}});
  EXPECT_NEAR(inside.at("eta"), 1.2f, 1e-6f);
}

// A curve between colours is of a surface in vacuum.
TEST_F(Exterior, CurvesKeepToVacuum) {
  const std::string curve =
      node("generalized_schlick_bsdf", "BSDF", "b",
           value_of("color0", "color3", "0.04, 0.04, 0.04") +
               value_of("scatter_mode", "string", "RT") + value_of("roughness", "vector2", "0, 0"));
  const auto kernels = within(curve);
  EXPECT_FALSE(reads(kernels->begin) || reads(kernels->sample) || reads(kernels->interior));
}

TEST_F(Exterior, IsReadByThoseWhoAskAlone) {
  const std::string glass = dielectric("1.5", "RT", value_of("roughness", "vector2", "0.2, 0.2"));
  EXPECT_TRUE(reads(within(glass)->begin));
  options_.varying = {"*", "exterior*"};
  const auto patterns = material(glass);
  const auto plain = in_vacuum(glass);
  for (const auto* kernels : {patterns.get(), plain.get()}) {
    ASSERT_NE(kernels, nullptr);
    EXPECT_FALSE(reads(kernels->begin) || reads(kernels->sample) || reads(kernels->evaluate));
  }
  const auto paper = within(node("oren_nayar_diffuse_bsdf", "BSDF", "b", ""));
  EXPECT_FALSE(reads(paper->begin) || reads(paper->sample));
}

// Vacuum by the channel is what there is without it, up to the rounding of what is folded then.
TEST_F(Exterior, VacuumIsOne) {
  const std::string glass = dielectric("1.5", "RT", value_of("roughness", "vector2", "0.2, 0.2"));
  const auto asked = within(glass);
  const auto plain = in_vacuum(glass);
  std::mt19937 random(5);
  const auto uniform = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
  for (int i = 0; i < 200; ++i) {
    const std::array<float, 3> u{uniform(), uniform(), uniform()};
    const double degrees = 89.0 * static_cast<double>(uniform());
    const Numbers expected = sample(*plain, 1.0f, degrees, i % 2 == 0, u);
    for (const auto& [name, number] : sample(*asked, 1.0f, degrees, i % 2 == 0, u)) {
      EXPECT_NEAR(number, expected.at(name), 2e-5f * std::abs(number) + 1e-6f) << name;
    }
  }
}

TEST_F(Exterior, AnyNumberIsSound) {
  const auto kernels =
      within(dielectric("1.5", "RT", value_of("roughness", "vector2", "0.2, 0.2")));
  using Limits = std::numeric_limits<float>;
  for (const float n : {0.0f, -3.0f, 1e-30f, 1e30f, Limits::infinity(), Limits::quiet_NaN()}) {
    for (const bool inside : {false, true}) {
      for (const auto& [name, number] : sample(*kernels, n, 30, inside, {0.3f, 0.6f, 0.5f})) {
        if (name != "flags" && name != "lobe") {
          EXPECT_TRUE(std::isfinite(number)) << name << ' ' << n;
        }
      }
    }
  }
}

}  // namespace
}  // namespace nacre
