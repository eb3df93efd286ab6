// Direct light against closed forms. Statistical tests use independent samples
// and fail a right program with a chance below 1e-4 (|z| < 4 with fixed seeds).
#include <gtest/gtest.h>

#include <numbers>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/mis.h"
#include "examples/render/render.h"
#include "tests/examples/render/statistics.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

constexpr double pi = std::numbers::pi;
constexpr Strategy strategies[] = {Strategy::bsdf_only, Strategy::light_only,
                                   Strategy::multiple_importance};

RenderSettings settings(Strategy strategy) {
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = 256;
  s.sampler = SamplerKind::independent;
  s.strategy = strategy;
  s.threads = 2;
  s.max_depth = 1;
  s.roulette_depth = 100;
  return s;
}

Film rendered(const RenderInput& input, const RenderSettings& s) {
  Diagnostics diagnostics;
  RenderStatistics statistics;
  std::optional<Film> film = render(input, s, diagnostics, {}, &statistics);
  EXPECT_TRUE(film) << diagnostics.to_string();
  EXPECT_EQ(statistics.invalid_results, 0u);
  return film ? *std::move(film) : Film(s.width, s.height);
}

/// Form factor from a surface element to a parallel rectangle a by b at height
/// h, one corner above the element (Howell, "A Catalog of Radiation Heat
/// Transfer Configuration Factors", B-3).
double corner_form_factor(double a, double b, double h) {
  const double x = a / h, y = b / h;
  const double p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * pi);
}

/// A floor, a light of radiance 3 above its middle, and a camera that sees a spot there.
Scene floor_and_light() {
  Scene scene;
  scene.meshes.push_back(make_quad("floor", {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
  scene.meshes.push_back(
      make_quad_light("lamp", {-0.5f, 1.f, -0.75f}, {1.f, 0, 0}, {0, 0, 1.5f}, {3.f, 3.f, 3.f}));
  scene.cameras = {{"", look_at({4.f, 0.7f, 0.f}, {0.f, 0.f, 0.f}, 1e-3f)}};
  return scene;
}

TEST(DirectLight, QuadGivesItsFormFactor) {
  const Scene scene = floor_and_light();
  const LambertShader grey({0.6f, 0.3f, 1.f});
  const double form_factor = 4 * corner_form_factor(0.5, 0.75, 1.0);
  for (const Strategy strategy : strategies) {
    const Film film =
        rendered({&scene, {&grey, nullptr}, nullptr, scene.cameras[0].camera}, settings(strategy));
    EXPECT_LT(z_score(estimate(film, 0), 0.6 * 3 * form_factor), 4);
    EXPECT_LT(z_score(estimate(film, 1), 0.3 * 3 * form_factor), 4);
    // A test that cannot fail proves nothing: the spread is a hundredth or less.
    EXPECT_LT(std::sqrt(estimate(film, 2).variance), 0.01 * estimate(film, 2).mean);
  }
}

// E = π L sin²θ for a disk of half angle θ above (Howell B-12).
TEST(DirectLight, DiskGivesItsSolidAngle) {
  Scene scene;
  scene.meshes.push_back(make_quad("floor", {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
  Mesh disk;
  constexpr int corners = 256;
  disk.position.push_back({0.f, 2.f, 0.f});
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * pi * i / corners;
    disk.position.push_back(
        {static_cast<float>(std::cos(a)), 2.f, static_cast<float>(std::sin(a))});
    disk.triangles.push_back({{0, static_cast<std::uint32_t>(1 + i),
                               static_cast<std::uint32_t>(1 + (i + 1) % corners)}});
  }
  disk.normal.assign(disk.position.size(), {0.f, -1.f, 0.f});
  disk.tangent.assign(disk.position.size(), {{1.f, 0.f, 0.f}, 1.f});
  disk.light_radiance = Vec3{1.f, 2.f, 4.f};
  disk.light_two_sided = true;
  scene.meshes.push_back(disk);
  const LambertShader white({1.f, 1.f, 1.f});
  const Camera camera = look_at({4.f, 0.7f, 0.f}, {0.f, 0.f, 0.f}, 1e-3f);
  // The polygon inscribed in the unit circle has 1 - 1e-4 of its area.
  const double form_factor = 1.0 / (1 + 4) * std::sin(2 * pi / corners) / (2 * pi / corners);
  for (const Strategy strategy : strategies) {
    const Film film = rendered({&scene, {&white, nullptr}, nullptr, camera}, settings(strategy));
    for (int c = 0; c < 3; ++c) {
      EXPECT_LT(z_score(estimate(film, c), std::ldexp(form_factor, c)), 4);
    }
  }
}

TEST(DirectLight, BackOfAOneSidedLightIsDark) {
  Scene scene = floor_and_light();
  std::swap(scene.meshes[1].triangles[0].v[1], scene.meshes[1].triangles[0].v[2]);
  std::swap(scene.meshes[1].triangles[1].v[1], scene.meshes[1].triangles[1].v[2]);
  const LambertShader white({1.f, 1.f, 1.f});
  for (const Strategy strategy : strategies) {
    const Film film =
        rendered({&scene, {&white, nullptr}, nullptr, scene.cameras[0].camera}, settings(strategy));
    EXPECT_EQ(estimate(film, 0).mean, 0);
  }
}

TEST(DirectLight, CameraSeesTheLightItself) {
  Scene scene = floor_and_light();
  const LambertShader white({1.f, 1.f, 1.f});
  RenderSettings s = settings(Strategy::multiple_importance);
  s.max_depth = 0;
  const Camera up = look_at({0.1f, 0.5f, 0.2f}, {0.1f, 1.f, 0.21f}, 0.01f);
  const Film film = rendered({&scene, {&white, nullptr}, nullptr, up}, s);
  EXPECT_EQ(estimate(film, 1).mean, 3);
  const Film floor = rendered({&scene, {&white, nullptr}, nullptr, scene.cameras[0].camera}, s);
  EXPECT_EQ(estimate(floor, 1).mean, 0);
}

// A material's own emission has to be found by light sampling too.
TEST(DirectLight, EmissiveMaterialLightsLikeAnAreaLight) {
  Scene scene = floor_and_light();
  scene.meshes[1].light_radiance.reset();
  const LambertShader grey({0.5f, 0.5f, 0.5f}), glowing({0.f, 0.f, 0.f}, {3.f, 1.f, 0.5f});
  const double form_factor = 4 * corner_form_factor(0.5, 0.75, 1.0);
  for (const Strategy strategy : strategies) {
    const Film film =
        rendered({&scene, {&grey, &glowing}, nullptr, scene.cameras[0].camera}, settings(strategy));
    EXPECT_LT(z_score(estimate(film, 0), 0.5 * 3 * form_factor), 4);
    EXPECT_LT(z_score(estimate(film, 2), 0.5 * 0.5 * form_factor), 4);
  }
}

TEST(Opacity, PanelShowsWhatIsBehindInProportion) {
  Scene scene;
  scene.meshes.push_back(make_quad("panel", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
  scene.meshes.push_back(make_quad("panel2", {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}));
  const LambertShader panel({0.f, 0.f, 0.f}, {}, {0.25f, 0.5f, 1.f});
  const Environment sky = Environment::constant({1.f, 2.f, 4.f});
  const Camera camera = look_at({0, 0, 3}, {0, 0, 0}, 0.1f);
  const Film film =
      rendered({&scene, {&panel, &panel}, &sky, camera}, settings(Strategy::multiple_importance));
  EXPECT_LT(z_score(estimate(film, 0), 0.75 * 0.75), 4);
  EXPECT_LT(z_score(estimate(film, 1), 2 * 0.5 * 0.5), 4);
  EXPECT_EQ(estimate(film, 2).mean, 0);
}

TEST(Opacity, ShadowIsAsDeepAsThePanelIsOpaque) {
  Scene scene = floor_and_light();
  const double form_factor = 4 * corner_form_factor(0.5, 0.75, 1.0);
  scene.meshes.push_back(make_quad("panel", {-2, 0.5f, 2}, {4, 0, 0}, {0, 0, -4}));
  scene.meshes.push_back(make_quad("panel2", {-2, 0.6f, 2}, {4, 0, 0}, {0, 0, -4}));
  const LambertShader white({1.f, 1.f, 1.f});
  const LambertShader panel({0.f, 0.f, 0.f}, {}, {0.25f, 0.5f, 1.f});
  // Below the panels.
  const Camera camera = look_at({4.f, 0.3f, 0.f}, {0.f, 0.f, 0.f}, 1e-3f);
  for (const Strategy strategy : strategies) {
    const Film film =
        rendered({&scene, {&white, nullptr, &panel, &panel}, nullptr, camera}, settings(strategy));
    EXPECT_LT(z_score(estimate(film, 0), 3 * form_factor * 0.75 * 0.75), 4);
    EXPECT_LT(z_score(estimate(film, 1), 3 * form_factor * 0.25), 4);
    EXPECT_EQ(estimate(film, 2).mean, 0);
  }
}

// Behind a panel, paths that passed it and paths that it scattered meet the same
// surface with different depths; light sampling has to stop for those at their last.
TEST(Opacity, DepthLimitHoldsPathByPath) {
  Scene scene;
  scene.meshes.push_back(make_quad("floor", {-20, 0, 20}, {40, 0, 0}, {0, 0, -40}));
  scene.meshes.push_back(make_quad("panel", {-4, 0.1f, 0}, {8, 0, 0}, {0, 4, 0}));
  const LambertShader white({1.f, 1.f, 1.f});
  const LambertShader panel({1.f, 1.f, 1.f}, {}, {0.5f, 0.5f, 0.5f});
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  const Camera camera = look_at({0, 2, 4}, {0, 1, 0}, 0.3f);
  const RenderInput input = {&scene, {&white, &panel}, &sky, camera};
  const Estimate bsdf = estimate(rendered(input, settings(Strategy::bsdf_only)), 0);
  for (const Strategy strategy : {Strategy::light_only, Strategy::multiple_importance}) {
    RenderSettings s = settings(strategy);
    s.seed = 1;
    EXPECT_LT(z_score(estimate(rendered(input, s), 0), bsdf), 4);
  }
  EXPECT_LT(std::sqrt(bsdf.variance), 0.01 * bsdf.mean);
}

TEST(Opacity, PassingThroughIsBounded) {
  Scene scene;
  std::vector<const Shader*> shaders;
  const LambertShader clear({0.f, 0.f, 0.f}, {}, {0.f, 0.f, 0.f});
  for (int i = 0; i < 20; ++i) {
    scene.meshes.push_back(
        make_quad("pane", {-1, -1, -static_cast<float>(i)}, {2, 0, 0}, {0, 2, 0}));
    shaders.push_back(&clear);
  }
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  const Camera camera = look_at({0, 0, 3}, {0, 0, 0}, 0.01f);
  RenderSettings s = settings(Strategy::multiple_importance);
  s.max_transparent = 20;
  EXPECT_EQ(estimate(rendered({&scene, shaders, &sky, camera}, s), 0).mean, 1);
  s.max_transparent = 19;
  EXPECT_EQ(estimate(rendered({&scene, shaders, &sky, camera}, s), 0).mean, 0);
}

TEST(PowerHeuristic, WeightsAddUpAndNeverOverflow) {
  for (const float a : {0.f, 1e-30f, 1.f, 1e30f, INFINITY}) {
    for (const float b : {0.f, 1e-30f, 1.f, 1e30f}) {
      const float w = power_heuristic(a, b);
      EXPECT_TRUE(w >= 0.f && w <= 1.f) << a << ' ' << b;
      if (a > 0.f || b > 0.f) {
        EXPECT_NEAR(w + power_heuristic(b, a), 1.f, 1e-6f) << a << ' ' << b;
      }
    }
  }
  EXPECT_FLOAT_EQ(power_heuristic(3.f, 4.f), 9.f / 25.f);
}

}  // namespace
}  // namespace nacre::host
