// Light in media: how far it goes, where it is scattered to, and scenes whose light is known.
#include "examples/render/medium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/mesh.h"
#include "examples/render/render.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

constexpr double pi = std::numbers::pi;

// Henyey and Greenstein 1941: the mean cosine is g, and the density
// (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^1.5).
TEST(Phase, IsHenyeyAndGreensteins) {
  const Vec3 along = normalize({0.3f, -0.5f, 0.8f});
  for (const double g : {-0.95, -0.3, -1e-6, 0.0, 1e-4, 0.5, 0.99}) {
    double mean = 0.0, solid_angle = 0.0;
    const int n = 400;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < 16; ++j) {
        const Uniform2 u{(static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / 16};
        const Scattered to = sample_phase(static_cast<float>(g), along, u);
        const double cosine = dot(to.direction, along);
        mean += cosine / (16 * n);
        solid_angle += 1.0 / to.pdf / (16 * n);
        EXPECT_NEAR(length(to.direction), 1.f, 1e-5f);
        const double base = 1 + g * g - 2 * g * cosine;
        EXPECT_NEAR(to.pdf * 4 * pi * std::pow(base, 1.5) / (1 - g * g), 1.0, 2e-2)
            << g << ' ' << i;
        // The share of light that is scattered further back is the random number: the density's
        // integral over cosines below.
        const auto below = [&](double c) {
          return (1 - g * g) / (2 * g) * (1 / std::sqrt(1 + g * g - 2 * g * c) - 1 / (1 + g));
        };
        if (std::abs(g) > 0.01) {
          // The cosine of two unit vectors of float has an error of 5e-7, which the density
          // multiplies.
          EXPECT_NEAR(below(cosine), u.x, 1e-4 + 5e-7 * 2 * pi * double(to.pdf)) << g;
        }
      }
    }
    EXPECT_NEAR(mean, g, 2e-3) << g;
    if (std::abs(g) < 0.9) {
      EXPECT_NEAR(solid_angle, 4 * pi, 0.02 * 4 * pi) << g;
    }
  }
}

// Beer's law: exp(-t d) goes all the way, and of the rest as much as scattering has of both is
// scattered; whatever channel the distance was drawn by.
TEST(Flight, KeepsTheLightOfEachChannel) {
  const Medium medium{{0.5f, 0.1f, 0.f}, {0.5f, 2.f, 0.3f}, 0.f};
  const double rates[3] = {1.0, 2.1, 0.3}, scattered[3] = {0.5, 2.0, 0.3};
  for (const Vec3 throughput : {Vec3{1, 1, 1}, Vec3{0.1f, 2, 0.5f}, Vec3{1, 0.2f, 0.01f}}) {
    for (const float far : {0.2f, 1.5f, INFINITY}) {
      double through[3] = {}, inside[3] = {};
      const int n = 700;
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const Uniform2 u{(static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n};
          const Flight flight = sample_flight(medium, throughput, far, u);
          double* sum = flight.scatters ? inside : through;
          const float weights[3] = {flight.weight.x, flight.weight.y, flight.weight.z};
          for (int c = 0; c < 3; ++c) sum[c] += weights[c] / double(n * n);
          EXPECT_LT(flight.distance, far);
        }
      }
      for (int c = 0; c < 3; ++c) {
        const double left = std::isinf(far) ? 0.0 : std::exp(-rates[c] * far);
        EXPECT_NEAR(through[c], left, 5e-3) << c << ' ' << far;
        EXPECT_NEAR(inside[c], scattered[c] / rates[c] * (1 - left), 5e-3) << c << ' ' << far;
      }
    }
  }
}

TEST(Flight, WithoutScatteringIsBeersLaw) {
  const Medium medium{{0.5f, 0.f, 3.f}, {}, 0.f};
  const Flight flight = sample_flight(medium, {1, 1, 1}, 2.f, {0.9f, 0.9f});
  EXPECT_FALSE(flight.scatters);
  EXPECT_FLOAT_EQ(flight.weight.x, std::exp(-1.f));
  EXPECT_EQ(flight.weight.y, 1.f);
  EXPECT_FLOAT_EQ(flight.weight.z, std::exp(-6.f));
  const Flight endless = sample_flight(medium, {1, 1, 1}, INFINITY, {0.9f, 0.9f});
  EXPECT_EQ(endless.weight.x, 0.f);
  EXPECT_EQ(endless.weight.y, 1.f);
}

// By where vertices are: a sphere's seam has two for one place. And not by their number of edges.
TEST(Solid, HasNoBorder) {
  Mesh ball = make_sphere("ball", {}, 1.f, 12);
  EXPECT_TRUE(is_closed(ball));
  std::swap(ball.triangles[5].v[0], ball.triangles[5].v[1]);
  EXPECT_FALSE(is_closed(ball));
  std::swap(ball.triangles[5].v[0], ball.triangles[5].v[1]);
  ball.triangles.pop_back();
  EXPECT_FALSE(is_closed(ball));
}

/// A surface that does not bend light, full of something.
class FullShader final : public LambertShader {
 public:
  explicit FullShader(const Medium& medium) : LambertShader({1.f, 1.f, 1.f}), medium_(medium) {}
  Capabilities capabilities() const override {
    Capabilities c;
    c.only_delta = true;
    c.has_interior = true;
    return c;
  }
  void sample(const ShadingBatch& batch, const void*, Lanes3, SampleLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(out.wi, i, -load(batch.wo, i));
      store(out.weight, i, {1.f, 1.f, 1.f});
      out.pdf[i] = 1.f;
      out.flags[i] = sample_valid | sample_delta | sample_transmitted;
    }
  }
  void interior(const ShadingBatch& batch, InteriorLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(out.absorption, i, medium_.absorption);
      store(out.scattering, i, medium_.scattering);
      out.anisotropy[i] = medium_.anisotropy;
    }
  }

 private:
  Medium medium_;
};

Vec3 mean(const Film& film) {
  Vec3 sum;
  for (const Vec3 rgb : film.pixels()) sum += rgb;
  return (1.f / static_cast<float>(film.pixels().size())) * sum;
}

Film rendered(const FullShader& shader, const Camera& camera, int samples) {
  Scene scene;
  scene.meshes.push_back(make_sphere("ball", {}, 1.f, 96));
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = samples;
  s.max_depth = 64;
  Diagnostics diagnostics;
  RenderStatistics statistics;
  const auto film = render({&scene, {&shader}, &sky, camera}, s, diagnostics, {}, &statistics);
  EXPECT_TRUE(film) << diagnostics.to_string();
  EXPECT_EQ(statistics.invalid_results, 0u);
  EXPECT_EQ(statistics.paths_cut, 0u);
  return *film;
}

// Through the middle of a ball of radius 1 light goes 2 units.
TEST(Interior, AbsorbsByBeersLaw) {
  const FullShader tinted(Medium{{0.1f, 0.5f, 2.f}, {}, 0.f});
  const Vec3 through = mean(rendered(tinted, look_at({0, 0, 5}, {}, 0.01f), 16));
  EXPECT_NEAR(through.x, std::exp(-0.2f), 2e-3f);
  EXPECT_NEAR(through.y, std::exp(-1.f), 2e-3f);
  EXPECT_NEAR(through.z, std::exp(-4.f), 1e-3f);
}

// A furnace: what scatters and does not absorb returns a uniform sky as it is, however dense and
// whatever its phase function.
TEST(Interior, WithoutAbsorptionNothingIsLost) {
  for (const float g : {-0.5f, 0.f, 0.8f}) {
    const FullShader milk(Medium{{}, {1.f, 4.f, 12.f}, g});
    const Vec3 light = mean(rendered(milk, look_at({0, 0, 5}, {}, 0.3f), 256));
    EXPECT_NEAR(light.x, 1.f, 5e-3f) << g;
    EXPECT_NEAR(light.y, 1.f, 5e-3f) << g;
    EXPECT_NEAR(light.z, 1.f, 1e-2f) << g;
  }
}

// Beyond the scene there is no surface: a medium that was entered and never left is dark.
TEST(Interior, WhatIsNeverLeftIsDark) {
  Scene scene;
  Mesh sheet = make_sphere("cap", {}, 1.f, 48);
  std::erase_if(sheet.triangles,
                [&](const Triangle& t) { return sheet.position[t.v[0]].z < 0.5f; });
  scene.meshes.push_back(std::move(sheet));
  const FullShader black(Medium{{1.f, 1.f, 1.f}, {}, 0.f});
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  RenderSettings s;
  s.width = s.height = 4;
  s.samples = 4;
  Diagnostics diagnostics;
  const auto film = render({&scene, {&black}, &sky, look_at({0, 0, 5}, {}, 0.01f)}, s, diagnostics);
  ASSERT_TRUE(film);
  EXPECT_EQ(mean(*film).x, 0.f);
}

}  // namespace
}  // namespace nacre::host
