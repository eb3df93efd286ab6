// Light below surfaces, in scenes whose light is known.
#include <gtest/gtest.h>

#include <cmath>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/medium.h"
#include "examples/render/render.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

/// All light goes below.
class FleshShader final : public LambertShader {
 public:
  explicit FleshShader(const Medium& medium) : LambertShader({1.f, 1.f, 1.f}), medium_(medium) {}
  Capabilities capabilities() const override {
    Capabilities c;
    c.has_subsurface = true;
    return c;
  }
  void sample(const ShadingBatch& batch, const void* state, Lanes3 u,
              SampleLanes out) const override {
    LambertShader::sample(batch, state, u, out);
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(out.wi, i, -load(out.wi, i));
      out.pdf[i] = 1.f;
      out.flags[i] = sample_valid | sample_delta | sample_transmitted | sample_subsurface;
      out.lobe[i] = 3;
    }
  }
  void evaluate(const ShadingBatch& batch, const void*, Lanes3, EvaluateLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(out.value, i, {});
      out.pdf[i] = 0.f;
    }
  }
  void subsurface(const ShadingBatch& batch, const std::int32_t*,
                  SubsurfaceLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(out.medium.absorption, i, medium_.absorption);
      store(out.medium.scattering, i, medium_.scattering);
      out.medium.anisotropy[i] = medium_.anisotropy;
      store(out.albedo, i, {1.f, 1.f, 1.f});
      store(out.normal, i, -load(batch.N, i));  // Either side will do.
    }
  }

 private:
  Medium medium_;
};

struct Lit {
  Vec3 mean;
  RenderStatistics statistics;
};

Lit lit(const Medium& medium, const Environment& sky, int samples,
        Strategy strategy = Strategy::multiple_importance, int max_depth = 64) {
  Scene scene;
  scene.meshes.push_back(make_sphere("ball", {}, 1.f, 96));
  const FleshShader flesh(medium);
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = samples;
  s.max_depth = max_depth;
  s.max_scatterings = 1 << 20;
  s.strategy = strategy;
  Diagnostics diagnostics;
  Lit result;
  const auto film = render({&scene, {&flesh}, &sky, look_at({0, 0, 5}, {}, 0.2f)}, s, diagnostics,
                           {}, &result.statistics);
  EXPECT_TRUE(film) << diagnostics.to_string();
  EXPECT_EQ(result.statistics.invalid_results, 0u);
  EXPECT_EQ(result.statistics.paths_cut, 0u);
  for (const Vec3 rgb : film->pixels()) result.mean += (1.f / 256.f) * rgb;
  return result;
}

// A furnace: what absorbs nothing sends all light back, however far it goes below.
TEST(Subsurface, WithoutAbsorptionNothingIsLost) {
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  for (const float g : {-0.5f, 0.f, 0.8f}) {
    for (const float density : {0.5f, 4.f, 50.f}) {
      // Every path brings 1, whatever it meets.
      const Medium grey{{}, {density, density, density}, g};
      const Vec3 light = lit(grey, sky, 16, Strategy::bsdf_only).mean;
      EXPECT_NEAR(light.y, 1.f, 2e-3f) << g << ' ' << density;
    }
  }
  // Channels of other paths than the one that a distance is drawn by make noise.
  const Vec3 light = lit({{}, {0.5f, 4.f, 20.f}, 0.f}, sky, 512).mean;
  EXPECT_NEAR(light.x, 1.f, 1e-2f);
  EXPECT_NEAR(light.y, 1.f, 1e-2f);
  EXPECT_NEAR(light.z, 1.f, 1e-2f);
}

// A ball that only absorbs: chords from a cosine are 2 cos long, so that of the light the integral
// of 2 m exp(-2 t m) over m is left.
TEST(Subsurface, WithoutScatteringIsBeersLaw) {
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  const Vec3 light = lit({{0.25f, 1.f, 3.f}, {}, 0.f}, sky, 256).mean;
  const auto left = [](double t) { return 2 * (1 - std::exp(-2 * t) * (1 + 2 * t)) / (4 * t * t); };
  EXPECT_NEAR(light.x, left(0.25), 3e-3);
  EXPECT_NEAR(light.y, left(1.0), 3e-3);
  EXPECT_NEAR(light.z, left(3.0), 3e-3);
}

// Against a ball 400 mean free paths wide a half-space has the same albedo: by Chandrasekhar's H,
// 0.5967 where 0.95 of what is met scatters, and 0.2566 of 0.7 (subsurface_medium_test.cpp has the
// integral).
TEST(Subsurface, OfADenseBallIsThatOfAHalfSpace) {
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  const Vec3 light = lit({{10.f, 60.f, 60.f}, {190.f, 140.f, 140.f}, 0.f}, sky, 256).mean;
  EXPECT_NEAR(light.x, 0.5967f, 1e-2f);
  EXPECT_NEAR(light.y, 0.2566f, 1e-2f);
}

// What leaves is lit like any surface: with light sampling and without, and by one bounce alone.
TEST(Subsurface, StrategiesAgree) {
  const Environment sky = Environment::studio();
  const Medium medium{{0.1f, 0.4f, 1.f}, {4.f, 8.f, 12.f}, 0.2f};
  const Vec3 both = lit(medium, sky, 256).mean;
  const Vec3 found = lit(medium, sky, 1024, Strategy::bsdf_only).mean;
  const Vec3 once = lit(medium, sky, 256, Strategy::multiple_importance, 1).mean;
  for (const auto channel : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    EXPECT_GT(both.*channel, 0.05f);
    EXPECT_NEAR(found.*channel / both.*channel, 1.f, 2e-2f);
    EXPECT_NEAR(once.*channel / both.*channel, 1.f, 2e-2f);
  }
}

}  // namespace
}  // namespace nacre::host
