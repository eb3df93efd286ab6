#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/render.h"
#include "tests/examples/render/statistics.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

struct BuiltIn {
  Scene scene = make_builtin_scene();
  LambertShader ball{{0.8f, 0.5f, 0.2f}}, base{{0.3f, 0.3f, 0.4f}}, ground{{0.5f, 0.5f, 0.5f}};
  Environment sky = Environment::studio();

  RenderInput input() const {
    return {&scene, {&ball, &base, &ground, nullptr}, &sky, scene.cameras[0].camera};
  }
};

Film rendered(const RenderInput& input, const RenderSettings& s) {
  Diagnostics diagnostics;
  RenderStatistics statistics;
  std::optional<Film> film = render(input, s, diagnostics, {}, &statistics);
  EXPECT_TRUE(film) << diagnostics.to_string();
  EXPECT_EQ(statistics.invalid_results, 0u);
  return film ? *std::move(film) : Film(s.width, s.height);
}

bool identical(const Film& a, const Film& b) {
  return a.pixels().size() == b.pixels().size() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size() * sizeof(Vec3)) == 0;
}

// White reflects all of a uniform sky, so the object vanishes. Every path of a
// convex object has one event of weight 1: there is no noise to allow for.
TEST(Furnace, ConvexWhiteObjectVanishesExactly) {
  Scene scene;
  scene.meshes.push_back(make_sphere("ball", {}, 1.f, 24));
  const LambertShader white({1.f, 1.f, 1.f});
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  RenderSettings s;
  s.width = s.height = 32;
  s.samples = 8;
  s.strategy = Strategy::bsdf_only;
  s.max_depth = 1;
  const Film film = rendered({&scene, {&white}, &sky, look_at({0, 0, 3}, {0, 0, 0}, 0.8f)}, s);
  for (const Vec3 rgb : film.pixels()) {
    EXPECT_EQ(rgb.x, 1.f);
    EXPECT_EQ(rgb.z, 1.f);
  }
}

TEST(Furnace, HoldsWithLightSamplingInConcaveScenes) {
  BuiltIn b;
  b.scene.meshes.pop_back();  // the lamp
  const LambertShader white({1.f, 1.f, 1.f});
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  RenderSettings s;
  s.width = s.height = 32;
  s.samples = 64;
  s.max_depth = 200;
  s.sampler = SamplerKind::independent;
  const Film film =
      rendered({&b.scene, {&white, &white, &white}, &sky, b.scene.cameras[0].camera}, s);
  // The object fills the middle of the image. 192 comparisons at 1 % together: 4.04 sigma.
  for (int y = 0; y < 32; y += 4) {
    for (int x = 0; x < 32; x += 4) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_LT(z_score(estimate(film, c, x, y, x + 4, y + 4), 1), 4.04) << x << ' ' << y;
      }
    }
  }
}

TEST(Integrator, StrategiesConvergeToTheSameImage) {
  const BuiltIn b;
  RenderSettings s;
  s.width = s.height = 48;
  s.sampler = SamplerKind::independent;
  s.max_depth = 4;
  s.roulette_depth = 2;
  s.samples = 64;
  const Film both = rendered(b.input(), s);
  s.seed = 1;
  s.strategy = Strategy::light_only;
  const Film light = rendered(b.input(), s);
  s.seed = 2;
  s.strategy = Strategy::bsdf_only;
  s.samples = 256;
  const Film bsdf = rendered(b.input(), s);
  // 9 blocks, 3 channels, 2 comparisons at 1 % together: 3.74 sigma.
  for (int y = 0; y < 48; y += 16) {
    for (int x = 0; x < 48; x += 16) {
      for (int c = 0; c < 3; ++c) {
        const Estimate e = estimate(both, c, x, y, x + 16, y + 16);
        EXPECT_LT(z_score(e, estimate(light, c, x, y, x + 16, y + 16)), 3.74) << x << ' ' << y;
        EXPECT_LT(z_score(e, estimate(bsdf, c, x, y, x + 16, y + 16)), 3.74) << x << ' ' << y;
      }
    }
  }
}

// What lights do not draw, paths find; and what both draw is shared with less noise.
TEST(Integrator, LightDrawnAboveTheMeanIsTheSameImageWithLessNoise) {
  BuiltIn b;
  b.scene.meshes.pop_back();  // the lamp
  RenderInput input = b.input();
  input.shaders.pop_back();
  RenderSettings s;
  s.width = s.height = 48;
  s.sampler = SamplerKind::independent;
  s.max_depth = 4;
  s.samples = 256;
  const Film all = rendered(input, s);
  s.seed = 1;
  b.sky = Environment::studio(1.f, 0.f, Environment::Drawn::above_mean);
  const Film above = rendered(input, s);
  double before = 0, after = 0;
  // 9 blocks, 3 channels at 1 % together: 3.56 sigma.
  for (int y = 0; y < 48; y += 16) {
    for (int x = 0; x < 48; x += 16) {
      for (int c = 0; c < 3; ++c) {
        const Estimate e = estimate(all, c, x, y, x + 16, y + 16);
        const Estimate a = estimate(above, c, x, y, x + 16, y + 16);
        EXPECT_LT(z_score(e, a), 3.56) << x << ' ' << y;
        before += e.variance;
        after += a.variance;
      }
    }
  }
  std::printf("variance %.3g, of all %.3g\n", after, before);
  EXPECT_LT(after, 0.75 * before);
}

TEST(Integrator, SamplersConvergeToTheSameImage) {
  const BuiltIn b;
  RenderSettings s;
  s.width = s.height = 32;
  s.samples = 64;
  s.max_depth = 3;
  const Film sobol = rendered(b.input(), s);
  s.sampler = SamplerKind::independent;
  const Film independent = rendered(b.input(), s);
  for (int c = 0; c < 3; ++c) {
    // The stratified film's own variance estimate is too large, so this is on the safe side;
    // stratification must not make it worse than the independent one.
    const Estimate a = estimate(sobol, c), e = estimate(independent, c);
    EXPECT_LT(std::abs(a.mean - e.mean), 4 * std::sqrt(2 * e.variance));
  }
}

TEST(Integrator, ImageIsTheSameForAnyNumberOfThreads) {
  const BuiltIn b;
  RenderSettings s;
  s.width = 70;
  s.height = 50;
  s.samples = 6;
  s.tile_size = 16;
  s.threads = 1;
  const Film one = rendered(b.input(), s);
  for (const int threads : {2, 4, 7}) {
    s.threads = threads;
    EXPECT_TRUE(identical(one, rendered(b.input(), s))) << threads;
  }
}

// A point's result must not depend on the points around it.
TEST(Integrator, ImageIsTheSameForAnyBatchSize) {
  const BuiltIn b;
  RenderSettings s;
  s.width = s.height = 40;
  s.samples = 4;
  const Film one = rendered(b.input(), s);
  for (const std::uint32_t batch : {16u, 100u, 4096u}) {
    s.batch_size = batch;
    EXPECT_TRUE(identical(one, rendered(b.input(), s))) << batch;
  }
}

TEST(Integrator, SeedsGiveDifferentNoise) {
  const BuiltIn b;
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = 1;
  const Film one = rendered(b.input(), s);
  s.seed = 1;
  EXPECT_FALSE(identical(one, rendered(b.input(), s)));
}

TEST(Integrator, MirrorsMultiplyAndShowTheLight) {
  // Two facing mirrors at 45°: a periscope onto a lamp of radiance 7.
  Scene scene;
  scene.meshes.push_back(make_quad("low", {-1, -1, 1}, {2, 0, 0}, {0, 2, -2}));
  scene.meshes.push_back(make_quad("high", {-1, 3, 1}, {2, 0, 0}, {0, 2, -2}));
  scene.meshes.push_back(make_quad_light("lamp", {-5, -1, -9}, {10, 0, 0}, {0, 10, 0}, {7, 7, 7}));
  const MirrorShader silver({0.5f, 0.75f, 1.f});
  const Camera camera = look_at({0, 0, 5}, {0, 0, 0}, 0.1f);
  RenderSettings s;
  s.width = s.height = 8;
  s.samples = 4;
  s.max_depth = 2;
  const Film film = rendered({&scene, {&silver, &silver, nullptr}, nullptr, camera}, s);
  for (const Vec3 rgb : film.pixels()) {
    EXPECT_EQ(rgb.x, 7.f * 0.25f);
    EXPECT_EQ(rgb.y, 7.f * 0.5625f);
    EXPECT_EQ(rgb.z, 7.f);
  }
  s.max_depth = 1;
  EXPECT_EQ(estimate(rendered({&scene, {&silver, &silver, nullptr}, nullptr, camera}, s), 0).mean,
            0);
}

TEST(Integrator, RouletteDoesNotChangeTheMean) {
  BuiltIn b;
  RenderSettings s;
  s.width = s.height = 24;
  s.samples = 128;
  s.sampler = SamplerKind::independent;
  s.roulette_depth = 1;
  const Film with = rendered(b.input(), s);
  s.seed = 1;
  s.roulette_depth = 100;
  const Film without = rendered(b.input(), s);
  for (int c = 0; c < 3; ++c) EXPECT_LT(z_score(estimate(with, c), estimate(without, c)), 4);
}

TEST(Integrator, NonFiniteKernelResultsAreCountedNotShown) {
  BuiltIn b;
  const BrokenShader broken;
  RenderInput input = b.input();
  input.shaders[0] = &broken;
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = 2;
  Diagnostics diagnostics;
  RenderStatistics statistics;
  const std::optional<Film> film = render(input, s, diagnostics, {}, &statistics);
  ASSERT_TRUE(film);
  EXPECT_GT(statistics.invalid_results, 0u);
  for (const Vec3 rgb : film->pixels()) EXPECT_TRUE(is_finite(rgb));
}

TEST(Integrator, StopEndsTheRender) {
  const BuiltIn b;
  RenderSettings s;
  s.width = s.height = 64;
  s.threads = 1;
  std::stop_source source;
  std::vector<double> shares;
  RenderControl control;
  control.stop = source.get_token();
  control.progress = [&](double share) {
    shares.push_back(share);
    if (shares.size() == 2) source.request_stop();
  };
  Diagnostics diagnostics;
  EXPECT_FALSE(render(b.input(), s, diagnostics, control));
  EXPECT_EQ(shares.size(), 2u);
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST(Integrator, ProgressEndsAtOne) {
  const BuiltIn b;
  RenderSettings s;
  s.width = s.height = 64;
  s.samples = 1;
  double last = 0;
  RenderControl control;
  control.progress = [&last](double share) {
    EXPECT_GT(share, last);
    last = share;
  };
  Diagnostics diagnostics;
  EXPECT_TRUE(render(b.input(), s, diagnostics, control));
  EXPECT_EQ(last, 1);
}

TEST(Integrator, EmptySceneIsTheSky) {
  const Scene scene;
  const Environment sky = Environment::constant({0.25f, 0.5f, 1.f});
  RenderSettings s;
  s.width = 1;
  s.height = 1;
  const Film film = rendered({&scene, {}, &sky, {}}, s);
  EXPECT_EQ(film.mean(0, 0).y, 0.5f);
}

}  // namespace
}  // namespace nacre::host
