// The lights of whole scenes: what is drawn from a place, and that pictures have the light of all.
// Statistical tests fail a right program with a chance below 1e-4 (|z| < 4 with fixed seeds).
#include "examples/render/scene_lights.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <numbers>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/punctual_light.h"
#include "examples/render/render.h"
#include "examples/render/render_context.h"
#include "tests/examples/render/light_samples.h"
#include "tests/examples/render/statistics.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

constexpr double pi = std::numbers::pi;
using Kind = SceneLights::Kind;
using LightKind = PunctualLight::Kind;

/// A scene, what is on its meshes, and lights that no ray meets.
struct Lit {
  Scene scene;
  std::vector<const Shader*> shaders;
  std::vector<std::unique_ptr<const LightShader>> lights;
  const Environment* sky = nullptr;
  Camera camera = look_at({4.f, 1.5f, 0.f}, {}, 1e-3f);

  void add(Mesh mesh, const Shader* shader = nullptr) {
    scene.meshes.push_back(std::move(mesh));
    shaders.push_back(shader);
  }
  void add(const PunctualLight& light) {
    lights.push_back(std::make_unique<PunctualShader>(light));
  }
  RenderInput input() const {
    RenderInput result{&scene, shaders, sky, camera};
    for (const auto& light : lights) result.lights.push_back(light.get());
    return result;
  }
};

RenderSettings settings(Strategy strategy) {
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = 64;
  s.sampler = SamplerKind::independent;
  s.strategy = strategy;
  s.threads = 2;
  s.max_depth = 1;
  s.roulette_depth = 100;
  return s;
}

Film rendered(const Lit& lit, const RenderSettings& s) {
  Diagnostics diagnostics;
  RenderStatistics statistics;
  std::optional<Film> film = render(lit.input(), s, diagnostics, {}, &statistics);
  EXPECT_TRUE(film) << diagnostics.to_string();
  EXPECT_EQ(statistics.invalid_results, 0u);
  return film ? *std::move(film) : Film(s.width, s.height);
}

std::unique_ptr<RenderContext> context_of(const Lit& lit) {
  Diagnostics diagnostics;
  return std::make_unique<RenderContext>(lit.input(), RenderSettings(), diagnostics);
}

Mesh floor() { return make_quad("floor", {-50, 0, 50}, {100, 0, 0}, {0, 0, -100}); }

PunctualLight point(Vec3 position, Vec3 color) {
  return {.kind = LightKind::point, .color = color, .position = position, .direction = {}};
}

/// One-sided lamps all over the room, above the floor, that look anywhere.
void add_lamps(Lit& lit, int count, std::uint32_t seed) {
  RandomLights random(seed);
  for (int i = 0; i < count; ++i) {
    const Vec3 at = random.point(3.f) + Vec3{0.f, 3.5f, 0.f};
    const Vec3 u = 0.1f * random.direction(), v = 0.1f * random.direction();
    const float power = std::exp(random.number(-1.f, 4.f));
    lit.add(make_quad_light("lamp", at, u, v, {power, 2.f * power, power}));
  }
}

TEST(SceneLights, ProbabilitiesOfChoicesAreThoseOfTheirDensities) {
  Lit lit;
  const LambertShader grey({0.5f, 0.5f, 0.5f}), glow({0.5f, 0.5f, 0.5f}, {1.f, 2.f, 3.f});
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  lit.sky = &sky;
  lit.add(floor(), &grey);
  add_lamps(lit, 30, 1);
  lit.add(make_sphere("ball", {1, 1, 1}, 0.3f, 8), &glow);
  lit.add(make_quad("card", {-2, 1, 0}, {0.5f, 0, 0}, {0, 0.5f, 0}), &glow);
  lit.add(point({1, 2, 0}, {3, 3, 3}));
  lit.add({.kind = LightKind::directional,
           .color = {1, 1, 1},
           .position = {},
           .direction = {0, -1, 0}});
  const auto context = context_of(lit);
  const SceneLights& lights = context->lights;
  EXPECT_FLOAT_EQ(lights.environment_chance(), 1.f / 3.f);
  RandomLights random(2);
  int triangles = 0, both = 0, unmet = 0;
  for (int i = 0; i < 100; ++i) {
    const LitPlace from = random.place(4.f);
    double sum = 0.0;
    for (std::uint32_t mesh = 0; mesh < lit.scene.meshes.size(); ++mesh) {
      const Mesh& m = lit.scene.meshes[mesh];
      for (std::uint32_t t = 0; t < m.triangles.size(); ++t) {
        const Vec3 a = m.position[m.triangles[t].v[0]];
        const float area = 0.5f * length(cross(m.position[m.triangles[t].v[1]] - a,
                                               m.position[m.triangles[t].v[2]] - a));
        const float front = lights.area_pdf(from, mesh, t, false);
        EXPECT_TRUE(std::isfinite(front));
        EXPECT_TRUE(mesh != 0 || front == 0.f);  // The floor is dark.
        const bool is_card = mesh == 32;         // It shines on both sides, the others on one.
        EXPECT_EQ(lights.area_pdf(from, mesh, t, true), is_card ? front : 0.f);
        sum += double{front * area};
      }
    }
    EXPECT_LE(sum, 1.0 / 3 + 1e-5);  // The point light has the rest.
    for (int k = 0; k < 200; ++k) {
      const auto choice =
          lights.choose(from, {random.number(0.f, 0.9999999f), random.number(0.f, 0.9999999f)});
      if (choice.kind == Kind::none) continue;
      EXPECT_GT(choice.probability, 0.f);
      unmet += choice.kind == Kind::unmet;
      if (choice.kind == Kind::environment) {
        EXPECT_EQ(choice.probability, lights.environment_chance());
      }
      if (choice.kind != Kind::triangle) continue;
      ++triangles;
      both += choice.front && choice.back;
      EXPECT_EQ(choice.probability / choice.area,
                lights.area_pdf(from, choice.mesh, choice.triangle, choice.back));
      EXPECT_TRUE(choice.front || choice.back);
    }
  }
  EXPECT_GT(triangles, 1000);
  EXPECT_GT(both, 100);
  EXPECT_GT(unmet, 1000);
}

TEST(SceneLights, OneLightHasAllOfTheProbability) {
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  Lit one;
  one.add(floor(), &grey);
  one.add(point({1, 2, 0}, {3, 3, 3}));
  for (const float u : {0.f, 0.5f, 0x1.fffffep-1f}) {
    const auto choice = context_of(one)->lights.choose({{0, 0, 0}, {0, 1, 0}}, {u, u});
    EXPECT_EQ(choice.kind, Kind::unmet);
    EXPECT_EQ(choice.probability, 1.f);
  }
  Lit none;
  none.add(floor(), &grey);
  EXPECT_TRUE(context_of(none)->lights.empty());
  EXPECT_EQ(context_of(none)->lights.choose({}, {0.5f, 0.5f}).kind, Kind::none);
  EXPECT_EQ(estimate(rendered(none, settings(Strategy::multiple_importance)), 0).mean, 0);
}

TEST(SceneLights, DarkLightsAreNotDrawn) {
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  Lit lit;
  lit.add(floor(), &grey);
  lit.add(make_quad_light("off", {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, 0}));
  for (int i = 0; i < 5; ++i) lit.add(point({1, 1, static_cast<float>(i)}, {}));
  EXPECT_TRUE(context_of(lit)->lights.empty());
  lit.add(point({9, 9, 9}, {0, 0, 1e-6f}));
  const auto context = context_of(lit);
  for (int i = 0; i < 20; ++i) {
    const auto choice = context->lights.choose({{1, 0, 1}}, {0.05f * static_cast<float>(i), 0.f});
    EXPECT_EQ(choice.light, 5u);
    EXPECT_EQ(choice.probability, 1.f);
  }
  EXPECT_EQ(context->lights.area_pdf({{1, 0, 1}}, 1, 0, false), 0.f);
}

// Of two suns the brighter one is drawn more often, and one that the probes do not see sometimes.
TEST(SceneLights, FarLightsAreDrawnByTheirLight) {
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  Lit lit;
  lit.add(floor(), &grey);
  for (const float power : {3.f, 1.f, 0.f}) {
    lit.add({.kind = LightKind::directional,
             .color = {power, power, power},
             .position = {},
             .direction = {0, -1, 0}});
  }
  const auto context = context_of(lit);
  double counts[3] = {}, probabilities[3] = {};
  for (int i = 0; i < 1000; ++i) {
    const auto choice = context->lights.choose({}, {0.001f * static_cast<float>(i), 0.f});
    ASSERT_EQ(choice.kind, Kind::unmet);
    counts[choice.light] += 0.001;
    probabilities[choice.light] = double{choice.probability};
  }
  EXPECT_NEAR(probabilities[0], 3 * probabilities[1], 1e-5);
  EXPECT_NEAR(probabilities[0], 10 * probabilities[2], 1e-5);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(counts[i], probabilities[i], 2e-3);
}

// The floor under many points and spots, some of which end before it, has the sum of their closed
// forms.
TEST(SceneLights, ManyPointsGiveTheirSum) {
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  Lit lit;
  lit.add(floor(), &grey);
  RandomLights random(3);
  double expected = 0.0;
  for (int i = 0; i < 80; ++i) {
    PunctualLight light = point(random.point(3.f) + Vec3{0.f, 3.5f, 0.f}, {});
    const float power = std::exp(random.number(-1.f, 2.f));
    light.color = {power, power, power};
    if (i % 4 == 1) light.range = random.number(1.f, 8.f);
    if (i % 2 == 1) {
      light.kind = LightKind::spot;
      light.direction = normalize(random.direction() + Vec3{0.f, -0.8f, 0.f});
      light.inner_cos = 0.9f;
      light.outer_cos = 0.6f;
    }
    lit.add(light);
    // KHR_lights_punctual, at the origin.
    const double squared = double{dot(light.position, light.position)};
    const double d = std::sqrt(squared);
    double arrives = double{power} / squared * double{light.position.y} / d;
    if (light.range > 0.f) {
      arrives *= std::clamp(1 - std::pow(d / double{light.range}, 4.0), 0.0, 1.0);
    }
    if (light.kind == LightKind::spot) {
      const double cosine = -double{dot(light.direction, light.position)} / d;
      const double part = std::clamp((cosine - 0.6) / 0.3, 0.0, 1.0);
      arrives *= part * part;
    }
    expected += 0.5 / pi * arrives;
  }
  for (const Strategy strategy : {Strategy::light_only, Strategy::multiple_importance}) {
    const Estimate e = estimate(rendered(lit, settings(strategy)), 0);
    EXPECT_LT(z_score(e, expected), 4) << e.mean << ' ' << expected;
    EXPECT_LT(std::sqrt(e.variance), 0.01 * e.mean);
  }
}

// A ball of radiance L far away: E = pi L (r / d)^2 cos, and a tenth of a percent for its facets.
TEST(SceneLights, AFarBallGivesItsSolidAngle) {
  const LambertShader grey({0.5f, 0.5f, 0.5f}), glow({}, {40.f, 20.f, 10.f});
  Lit lit;
  lit.add(floor(), &grey);
  lit.add(make_sphere("ball", {0, 12, 9}, 1.f, 96), &glow);
  const double expected = 0.5 * 40 / 225.0 * 0.8;
  for (const Strategy strategy : {Strategy::light_only, Strategy::multiple_importance}) {
    const Estimate e = estimate(rendered(lit, settings(strategy)), 0);
    EXPECT_NEAR(e.mean, expected, 4 * std::sqrt(e.variance) + 2e-3 * expected);
    EXPECT_LT(std::sqrt(e.variance), 0.01 * e.mean);
  }
}

// However directions are found, the light is the same.
void expect_same_light(const Lit& lit, RenderSettings s, double precision = 0.03, int factor = 64) {
  s.strategy = Strategy::bsdf_only;
  RenderSettings many = s;
  many.samples *= factor;  // Paths seldom meet small lamps.
  const Estimate paths = estimate(rendered(lit, many), 0);
  EXPECT_LT(std::sqrt(paths.variance), precision * paths.mean);
  for (const Strategy strategy : {Strategy::light_only, Strategy::multiple_importance}) {
    s.strategy = strategy;
    s.seed = 1;
    const Estimate e = estimate(rendered(lit, s), 0);
    EXPECT_LT(z_score(e, paths), 4) << e.mean << ' ' << paths.mean;
    EXPECT_LT(std::sqrt(e.variance), precision * e.mean);
  }
}

TEST(SceneLights, LampsGiveWhatPathsFind) {
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  Lit lit;
  lit.add(floor(), &grey);
  add_lamps(lit, 60, 4);
  expect_same_light(lit, settings(Strategy::bsdf_only), 0.03, 256);
}

// From within a shining shell its fronts are not seen: paths find its backs.
TEST(SceneLights, BothSidesOfWhatIsClosedShine) {
  const LambertShader grey({0.5f, 0.5f, 0.5f}), glow({}, {1.f, 1.f, 1.f});
  Lit lit;
  lit.add(make_quad("floor", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}), &grey);
  lit.add(make_sphere("shell", {0, 0, 0}, 9.f, 24), &glow);
  lit.add(make_sphere("bulb", {0, 1, 0}, 0.3f, 12), &glow);
  expect_same_light(lit, settings(Strategy::bsdf_only));
  EXPECT_NEAR(estimate(rendered(lit, settings(Strategy::multiple_importance)), 0).mean, 0.5, 0.02);
}

/// Shines where its u is above a half, and strongest at its edge, which no probe sees.
class EdgeShader final : public LambertShader {
 public:
  explicit EdgeShader(float from) : LambertShader({}, {1.f, 1.f, 1.f}), from_(from) {}
  void emission(const ShadingBatch& batch, Lanes3 radiance) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const float glow = batch.uv.x[i] > from_ ? 50.f : 0.f;
      store(radiance, i, {glow, glow, glow});
    }
  }

 private:
  float from_;
};

TEST(SceneLights, WhatProbesDoNotSeeIsNotLost) {
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  const EdgeShader half(0.5f), edge(0.97f);
  for (const bool all_dark : {false, true}) {
    Lit lit;
    lit.add(floor(), &grey);
    const Shader* glow = all_dark ? static_cast<const Shader*>(&edge) : &half;
    for (int i = 0; i < 3; ++i) {
      const auto x = static_cast<float>(i);
      lit.add(make_quad("lamp", {x - 1.5f, 1.f, -0.5f}, {0.8f, 0, 0}, {0, 0, 1.f}),
              i == 1 ? glow : &edge);
    }
    RenderSettings s = settings(Strategy::bsdf_only);
    s.samples = 256;
    expect_same_light(lit, s, 0.2);
  }
}

// A lamp that moves is found by paths, whatever else is drawn.
TEST(SceneLights, MovingLampsShine) {
  const LambertShader grey({0.5f, 0.5f, 0.5f}), glow({}, {8.f, 8.f, 8.f});
  Lit lit;
  lit.add(floor(), &grey);
  add_lamps(lit, 10, 5);
  Mesh lamp = make_quad("moving", {-0.5f, 1.f, -0.5f}, {1, 0, 0}, {0, 0, 1});
  lamp.instances.push_back(
      Motion({{0.f, 1.f, {Affine{.origin = {-1, 0, 0}}, Affine{.origin = {1, 0.5f, 0}}}}}));
  lit.add(lamp, &glow);
  RenderSettings s = settings(Strategy::bsdf_only);
  s.shutter_close = 1.f;
  const auto context = context_of(lit);
  EXPECT_EQ(context->lights.area_pdf({{0, 0, 0}}, 11, 0, true), 0.f);
  RenderSettings many = s;
  many.samples *= 64;
  const Estimate paths = estimate(rendered(lit, many), 0);
  s.samples *= 16;
  s.strategy = Strategy::multiple_importance;
  EXPECT_LT(z_score(estimate(rendered(lit, s), 0), paths), 4);
}

/// Alike everywhere.
class FogShader final : public LambertShader {
 public:
  FogShader() : LambertShader({}) {}
  Capabilities capabilities() const override {
    Capabilities c;
    c.is_volume = true;
    return c;
  }
  void volume(const ShadingBatch& batch, VolumeLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(out.medium.absorption, i, {0.1f, 0.1f, 0.1f});
      store(out.medium.scattering, i, {0.3f, 0.3f, 0.3f});
      store(out.emission, i, {});
      out.medium.anisotropy[i] = 0.3f;
    }
  }
};

// Within fog there are no normals.
TEST(SceneLights, VolumesAreLitByTheSameLamps) {
  const FogShader fog;
  Lit lit;
  lit.camera = look_at({0, 3.5f, 12}, {0, 3.5f, 0}, 0.3f);
  lit.add(make_sphere("fog", {0, 3.5f, 0}, 6.f, 24), &fog);
  add_lamps(lit, 40, 6);
  RenderSettings s = settings(Strategy::bsdf_only);
  s.max_depth = 4;
  s.samples = 512;
  expect_same_light(lit, s, 0.07, 16);
}

}  // namespace
}  // namespace nacre::host
