// Volumes: what differs from place to place, what glows, and what is in them, where the light is
// known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/medium.h"
#include "examples/render/punctual_light.h"
#include "examples/render/render.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

/// A volume that is a function of the place in object space.
class CloudShader final : public LambertShader {
 public:
  using At = std::function<Medium(Vec3)>;
  explicit CloudShader(At at) : LambertShader({}), at_(std::move(at)), varies_(true) {}
  explicit CloudShader(const Medium& medium)
      : LambertShader({}), at_([medium](Vec3) { return medium; }) {}
  Capabilities capabilities() const override {
    Capabilities c;
    c.is_volume = true;
    c.volume_varies = varies_;
    c.attributes = attribute_object_space;
    return c;
  }
  void volume(const ShadingBatch& batch, VolumeLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      const Medium medium = at_(load(batch.P_object, i));
      store(out.medium.absorption, i, medium.absorption);
      store(out.medium.scattering, i, medium.scattering);
      store(out.emission, i, medium.emission);
      out.medium.anisotropy[i] = medium.anisotropy;
    }
  }

 private:
  At at_;
  bool varies_ = false;
};

Vec3 grey(float x) { return {x, x, x}; }

struct Lit {
  Vec3 mean;
  float deviation = 0.f;  ///< Of the mean of red.
  RenderStatistics statistics;
};

Lit lit(const Scene& scene, const std::vector<const Shader*>& shaders, const Environment& sky,
        int samples, float fov = 0.01f, Strategy strategy = Strategy::multiple_importance) {
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = samples;
  s.max_depth = 64;
  s.strategy = strategy;
  Diagnostics diagnostics;
  Lit result;
  const auto film = render({&scene, shaders, &sky, look_at({0, 0, 8}, {}, fov)}, s, diagnostics, {},
                           &result.statistics);
  EXPECT_TRUE(film) << diagnostics.to_string();
  EXPECT_EQ(result.statistics.invalid_results, 0u);
  EXPECT_EQ(result.statistics.paths_cut, 0u);
  for (const Vec3 rgb : film->pixels()) result.mean += (1.f / 256.f) * rgb;
  float variance = 0.f;
  for (int i = 0; i < 256; ++i) variance += film->variance(i % 16, i / 16).x;
  result.deviation = std::sqrt(variance) / 256.f;
  return result;
}

Lit ball(const CloudShader& cloud, float sky, int samples, float fov = 0.01f,
         Strategy strategy = Strategy::multiple_importance) {
  Scene scene;
  scene.meshes.push_back(make_sphere("ball", {}, 1.f, 96));
  return lit(scene, {&cloud}, Environment::constant(grey(sky)), samples, fov, strategy);
}

// Through the middle of the ball: absorption of (1 + z) / 2 comes to 1 over a way of 2.
TEST(Volume, AbsorbsWhatThereIsOnTheWay) {
  const CloudShader cloud([](Vec3 p) {
    const float half = 0.5f * (1.f + p.z);
    return Medium{{half, 2.f * half, 0.f}, {}, 0.f};
  });
  const Lit through = ball(cloud, 1.f, 256);
  EXPECT_NEAR(through.mean.x, std::exp(-1.f), 4e-3f);
  EXPECT_NEAR(through.mean.y, std::exp(-2.f), 4e-3f);
  EXPECT_NEAR(through.mean.z, 1.f, 1e-2f);
  EXPECT_EQ(through.statistics.beyond_bound, 0u);
}

// A furnace: what scatters alone gives back a uniform sky, wherever there is how much of it.
TEST(Volume, WithoutAbsorptionNothingIsLost) {
  const CloudShader cloud([](Vec3 p) {
    return Medium{{}, grey(p.x > 0.f ? 6.f : std::sin(9.f * p.y) > 0.f ? 1.f : 0.f), 0.4f};
  });
  const Vec3 paths = ball(cloud, 1.f, 16, 0.2f, Strategy::bsdf_only).mean;
  EXPECT_NEAR(paths.x, 1.f, 1e-3f);
  EXPECT_NEAR(paths.z, 1.f, 1e-3f);
  EXPECT_NEAR(ball(cloud, 1.f, 256, 0.2f).mean.x, 1.f, 5e-3f);
}

// The integral of e exp(-a t) over a way of 2, whether the volume knows that it is alike everywhere
// or not.
TEST(Volume, Glows) {
  const Medium medium{{0.f, 0.5f, 2.f}, {}, 0.f, {1.f, 2.f, 3.f}};
  const CloudShader alike(medium);
  const CloudShader unknown([&](Vec3) { return medium; });
  for (const CloudShader* cloud : {&alike, &unknown}) {
    const Vec3 light = ball(*cloud, 0.f, 256).mean;
    EXPECT_NEAR(light.x, 2.f, 1e-2f);
    EXPECT_NEAR(light.y, 2 * (1 - std::exp(-1.)) / 0.5, 2e-2f);
    EXPECT_NEAR(light.z, 3 * (1 - std::exp(-4.)) / 2, 2e-2f);
  }
}

// What is no number is nothing; a ray without end brings what it can.
TEST(Volume, OfAnythingIsANumber) {
  const float hostile[] = {0.f, -1.f, 1e-30f, 1e30f, INFINITY, -INFINITY, NAN};
  for (const float absorption : hostile) {
    for (const float emission : hostile) {
      const CloudShader cloud(
          Medium{grey(absorption), grey(emission), emission, {absorption, emission, 0.f}});
      Scene scene;
      scene.meshes.push_back(make_sphere("ball", {}, 1.f, 8));
      scene.meshes[0].triangles.resize(20);  // Not closed.
      const Lit result = lit(scene, {&cloud}, Environment::constant(grey(1.f)), 1, 0.3f);
      EXPECT_TRUE(is_finite(result.mean)) << absorption << ' ' << emission;
    }
  }
}

// The same medium as what is alike everywhere and as what might differ.
TEST(Volume, NullCollisionsChangeNoMean) {
  const Medium medium{{0.1f, 0.3f, 0.2f}, {1.f, 2.f, 3.f}, 0.3f};
  const CloudShader alike(medium);
  const CloudShader unknown(
      [&](Vec3 p) { return p.z > 2.f ? Medium{grey(9.f), {}, 0.f} : medium; });
  const Vec3 a = ball(alike, 1.f, 256, 0.2f).mean, b = ball(unknown, 1.f, 256, 0.2f).mean;
  EXPECT_NEAR(a.x, b.x, 1e-2f);
  EXPECT_NEAR(a.y, b.y, 1e-2f);
  EXPECT_NEAR(a.z, b.z, 1e-2f);
}

// Of u all together: what scatters, and what passes, over the bound; the bound need not be one.
TEST(Volume, MeetingsHaveTheMean) {
  for (const float bound : {2.f, 0.7f}) {
    const Medium there{{0.1f, 0.2f, 0.f}, {0.4f, 1.f, 0.f}, 0.f};
    const Vec3 throughput{1.f, 0.3f, 0.6f};
    double scattered[3] = {}, passed[3] = {};
    const int n = 100000;
    for (int i = 0; i < n; ++i) {
      const Meeting meeting =
          sample_meeting(there, bound, throughput, (static_cast<float>(i) + 0.5f) / n);
      double* sum = meeting.scatters ? scattered : passed;
      sum[0] += meeting.weight.x / double(n);
      sum[1] += meeting.weight.y / double(n);
      sum[2] += meeting.weight.z / double(n);
    }
    EXPECT_NEAR(scattered[0], 0.4 / bound, 1e-3);
    EXPECT_NEAR(scattered[1], 1.0 / bound, 1e-3);
    EXPECT_NEAR(passed[0], (bound - 0.5) / bound, 1e-3);
    EXPECT_NEAR(passed[1], (bound - 1.2) / bound, 1e-3);
    EXPECT_NEAR(passed[2], 1.0, 1e-3);
  }
}

// All strategies find the same light in smoke and behind it, of lamps within, lamps outside and the
// sky, and whether the smoke is alike everywhere or not.
TEST(Volume, EveryStrategyFindsTheSameLight) {
  Scene scene;
  scene.meshes.push_back(make_sphere("smoke", {}, 2.f, 48));
  scene.meshes.push_back(make_quad("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
  scene.meshes.push_back(
      make_quad_light("within", {0.7f, -1, 1}, {0, 2, 0}, {0.5f, 0, 0.3f}, grey(5)));
  scene.meshes.push_back(make_quad_light("outside", {-3, -1, 2}, {0, 2, 0}, {1, 0, -1}, grey(9)));
  const LambertShader white(grey(0.8f));
  const Environment dusk = Environment::constant(grey(0.1f));
  const CloudShader alike(Medium{grey(0.1f), grey(0.3f), 0.3f});
  const CloudShader unlike(
      [](Vec3 p) { return Medium{grey(0.1f), grey(0.3f + 0.25f * std::sin(4.f * p.x)), 0.3f}; });
  for (const CloudShader* smoke : {&alike, &unlike}) {
    const auto seen = [&](Strategy strategy, int samples) {
      return lit(scene, {smoke, &white, &white, &white}, dusk, samples, 0.35f, strategy);
    };
    const Lit paths = seen(Strategy::bsdf_only, 2048);
    for (const Strategy strategy : {Strategy::multiple_importance, Strategy::light_only}) {
      const Lit other = seen(strategy, 512);
      EXPECT_LT(std::hypot(paths.deviation, other.deviation), 2e-2f * paths.mean.x);
      EXPECT_LT(std::abs(other.mean.x - paths.mean.x),
                3.5f * std::hypot(paths.deviation, other.deviation))
          << paths.mean.x << ' ' << other.mean.x << ' ' << int(strategy);
    }
  }
}

// A sun straight above a floor with a slab of fog on it: Beer's law there and back; the fog does
// not scatter. And so where the fog might be different everywhere.
TEST(Volume, LightsWithoutASurfaceGetThrough) {
  Scene scene;
  scene.meshes.push_back(make_quad("floor", {-9, -9, -1.5f}, {18, 0, 0}, {0, 18, 0}));
  scene.meshes.push_back(make_sphere("fog", {}, 1.f, 256));
  const Vec3 rate{0.25f, 1.f, 0.f};
  const CloudShader alike(Medium{rate, {}, 0.f});
  const CloudShader unlike([&](Vec3 p) { return Medium{(1.f + p.z) * rate, {}, 0.f}; });
  const LambertShader white(grey(0.5f));
  const PunctualShader sun({.kind = PunctualLight::Kind::directional,
                            .color = grey(3),
                            .position = {},
                            .direction = {0, 0, -1}});
  const Environment night = Environment::constant({});
  RenderSettings s;
  s.width = s.height = 4;
  s.samples = 1024;
  for (const CloudShader* fog : {&alike, &unlike}) {
    Diagnostics diagnostics;
    const auto film = render({.scene = &scene,
                              .shaders = {&white, fog},
                              .environment = &night,
                              .camera = look_at({0, 0, 8}, {}, 1e-3f),
                              .lights = {&sun}},
                             s, diagnostics);
    ASSERT_TRUE(film);
    Vec3 mean;
    for (const Vec3 rgb : film->pixels()) mean += (1.f / 16.f) * rgb;
    const double lit = 3 * 0.5 / std::numbers::pi;
    EXPECT_NEAR(mean.x / lit, std::exp(-4 * 0.25), 1e-2);
    EXPECT_NEAR(mean.y / lit, std::exp(-4 * 1.0), 2e-3);
    EXPECT_NEAR(mean.z / lit, 1.0, 1e-4);
  }
}

// What scatters so little that light is scattered once: the integral over the way through the
// middle of the ball, with the way from the sun on the side (quadrature).
TEST(Volume, ScattersTheLightOfASun) {
  Scene scene;
  scene.meshes.push_back(make_sphere("ball", {}, 1.f, 256));
  const double absorbed = 1.0, scattered = 0.002, g = 0.6;
  const CloudShader thin(Medium{grey(float(absorbed)), grey(float(scattered)), float(g)});
  const PunctualShader sun({.kind = PunctualLight::Kind::directional,
                            .color = grey(1000),
                            .position = {},
                            .direction = {-1, 0, 0}});
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = 4096;
  Diagnostics diagnostics;
  const Environment night = Environment::constant({});
  const auto film = render({.scene = &scene,
                            .shaders = {&thin},
                            .environment = &night,
                            .camera = look_at({0, 0, 8}, {}, 1e-3f),
                            .lights = {&sun}},
                           s, diagnostics);
  ASSERT_TRUE(film);
  double mean = 0.0;
  for (const Vec3 rgb : film->pixels()) mean += rgb.x / 256.0;
  const double rate = absorbed + scattered;
  double known = 0.0;
  const int n = 10000;
  for (int i = 0; i < n; ++i) {
    const double z = -1 + 2 * (i + 0.5) / n;
    known += 2.0 / n * std::exp(-rate * (1 - z)) * std::exp(-rate * std::sqrt(1 - z * z));
  }
  // At right angles to the sun.
  const double phase = (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g, 1.5));
  EXPECT_NEAR(mean / (1000 * scattered * phase * known), 1.0, 2e-2);
}

// From the middle of a ball light has half the way out; what encloses that is there before and
// after, and what is only beside the camera is not.
TEST(Volume, CamerasMayBeWithin) {
  Scene scene;
  scene.meshes.push_back(make_sphere("inner", {}, 1.f, 96));
  scene.meshes.push_back(make_sphere("outer", {0.5f, 0, 0}, 3.f, 96));
  scene.meshes.push_back(make_sphere("beside", {0, 7, 0}, 2.f, 24));
  const CloudShader inner(Medium{{1.f, 0.f, 0.f}, {}, 0.f});
  const CloudShader outer([](Vec3) { return Medium{{0.f, 0.5f, 0.f}, {}, 0.f}; });
  const CloudShader beside(Medium{grey(9.f), {}, 0.f});
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = 256;
  Diagnostics diagnostics;
  const Environment sky = Environment::constant(grey(1.f));
  const auto film =
      render({&scene, {&inner, &outer, &beside}, &sky, look_at({0, 0, 0}, {1, 0, 0}, 1e-3f)}, s,
             diagnostics);
  ASSERT_TRUE(film);
  Vec3 mean;
  for (const Vec3 rgb : film->pixels()) mean += (1.f / 256.f) * rgb;
  EXPECT_NEAR(mean.x, std::exp(-1.0), 1e-3);
  EXPECT_NEAR(mean.y, std::exp(-0.5 * 2.5), 1e-2);
  EXPECT_EQ(mean.z, 1.f);
}

// A floor and a lamp in smoke: what light sampling finds is weakened on its way.
TEST(Volume, LightWithinIsWeakened) {
  Scene scene;
  scene.meshes.push_back(make_sphere("smoke", {}, 4.f, 64));
  scene.meshes.push_back(make_quad("floor", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
  scene.meshes.push_back(make_quad_light("lamp", {1.5f, -1, 2}, {0, 2, 0}, {1, 0, 0}, grey(5.f)));
  const LambertShader white(grey(0.8f));
  const Environment night = Environment::constant({});
  const auto seen = [&](const CloudShader& smoke, Strategy strategy, int samples) {
    return lit(scene, {&smoke, &white, &white}, night, samples, 0.1f, strategy).mean.x;
  };
  const CloudShader thin(Medium{grey(0.f), {}, 0.f}), thick(Medium{grey(0.3f), {}, 0.f});
  const float clear = seen(thin, Strategy::bsdf_only, 512);
  const float both = seen(thick, Strategy::multiple_importance, 512);
  const float paths = seen(thick, Strategy::bsdf_only, 512);
  EXPECT_GT(both, 0.f);
  EXPECT_NEAR(both / paths, 1.f, 5e-2f);
  // At least 2 units from the lamp, and 4 to where the smoke ends.
  EXPECT_LT(both / clear, std::exp(-0.3 * 6.0));
  EXPECT_GT(both / clear, std::exp(-0.3 * 9.0));
}

}  // namespace
}  // namespace nacre::host
