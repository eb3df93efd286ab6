// What bounds of lights promise: they hold what they are of, and never call dark what shines.
#include "examples/render/light_bounds.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/examples/render/light_samples.h"

namespace nacre::host {
namespace {

constexpr double pi = std::numbers::pi;

double angle(Vec3 a, Vec3 b) {
  const Vec3 c = cross(a, b);
  return std::atan2(double{length(c)}, double{dot(a, b)});
}
double opening(const DirectionCone& c) { return std::atan2(double{c.sin_o}, double{c.cos_o}); }

TEST(DirectionCone, UnionsHoldBoth) {
  RandomLights random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto cone = [&] {
      const float kind = random.number(0.f, 4.f);
      const float theta = kind < 1.f ? 0.f : kind < 2.f ? 1e-4f : random.number(0.f, 3.1415f);
      return DirectionCone::about(random.direction(), std::cos(theta));
    };
    DirectionCone a = cone();
    const DirectionCone b = cone();
    if (i % 5 == 0) a.axis = b.axis;
    if (i % 5 == 1) a.axis = -b.axis;
    const DirectionCone both = united(a, b);
    EXPECT_NEAR(length(both.axis), 1.f, 1e-6f);
    for (const DirectionCone& part : {a, b}) {
      const double farthest = angle(both.axis, part.axis) + opening(part);
      EXPECT_LE(std::min(farthest, pi), opening(both) + 1e-5) << i;
    }
    // It is the narrowest: their far edges, and no more.
    const double widest =
        std::max({opening(a), opening(b), 0.5 * (opening(a) + opening(b) + angle(a.axis, b.axis))});
    EXPECT_LE(opening(both), std::min(widest, pi) + 1e-3) << i;
  }
}

// The integral over directions w of max(0, cos max(0, theta - theta_o)) within theta_o + theta_e.
TEST(LightBounds, OrientationMeasureIsItsIntegral) {
  for (const double o : {0.0, 0.3, 1.0, 2.0, pi}) {
    for (const double e : {0.1, 0.7, pi / 2}) {
      LightBounds bounds;
      bounds.cone = DirectionCone::about({0, 0, 1}, static_cast<float>(std::cos(o)));
      bounds.cos_e = static_cast<float>(std::cos(e));
      double sum = 0;
      constexpr int steps = 20000;
      for (int i = 0; i < steps; ++i) {
        const double theta = pi * (i + 0.5) / steps;
        if (theta > o + e) break;
        sum += 2 * pi * std::sin(theta) * std::cos(std::max(0.0, theta - o)) * pi / steps;
      }
      EXPECT_NEAR(orientation_measure(bounds), sum, 2e-3) << o << ' ' << e;
    }
  }
}

// One point: all is known of it.
TEST(LightBounds, ImportanceOfAPointIsWhatArrives) {
  const TestLight point{
      .corners = {{0, 3, 4}, {0, 3, 4}, {0, 3, 4}}, .axis = {0, 0, 1}, .intensity = 7.f};
  EXPECT_NEAR(importance(point.bounds(), {{0, 0, 0}}), 7.0 / 25, 1e-6);
  EXPECT_NEAR(importance(point.bounds(), {{0, 0, 0}, {0, 1, 0}}), 0.6 * 7 / 25, 1e-6);
  EXPECT_NEAR(importance(point.bounds(), {{0, 0, 0}, {0, -1, 0}}), 0.6 * 7 / 25, 1e-6);
  TestLight spot = point;
  spot.axis = {0, -0.6f, -0.8f};
  spot.cos_o = 1.f;
  spot.cos_e = 0.9f;
  EXPECT_NEAR(importance(spot.bounds(), {{0, 0, 0}}), 7.0 / 25, 1e-6);
  spot.axis = {0, -1, 0};  // At an angle with the cosine 0.6.
  EXPECT_EQ(importance(spot.bounds(), {{0, 0, 0}}), 0.0);
  spot.cos_e = 0.5f;
  EXPECT_NEAR(importance(spot.bounds(), {{0, 0, 0}}), 0.6 * 7 / 25, 1e-6);
  spot.axis = {0, 1, 0};
  EXPECT_EQ(importance(spot.bounds(), {{0, 0, 0}}), 0.0);
  spot.both_ways = true;
  EXPECT_NEAR(importance(spot.bounds(), {{0, 0, 0}}), 0.6 * 7 / 25, 1e-6);
  spot.reach = 4.99f;
  EXPECT_EQ(importance(spot.bounds(), {{0, 0, 0}}), 0.0);
  spot.reach = 5.f;
  EXPECT_GT(importance(spot.bounds(), {{0, 0, 0}}), 0.0);
  spot.intensity = 0.f;
  EXPECT_TRUE(spot.bounds().is_dark());
  EXPECT_EQ(importance(spot.bounds(), {{0, 0, 0}}), 0.0);
}

// Whatever is united, none of it gets lost: that a light shines somewhere is all that
// lets it be drawn there.
TEST(LightBounds, WhatShinesHasImportanceInEveryGroup) {
  RandomLights random(2);
  int shining = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<TestLight> lights;
    LightBounds group;
    // Of a small and of a large group, near and far away.
    const float size = std::exp(random.number(-4.f, 3.f));
    const int count = 1 + static_cast<int>(random.number(0.f, 8.f));
    for (int k = 0; k < count; ++k) {
      lights.push_back(random_light(random, size));
      group = united(group, lights.back().bounds());
    }
    for (int k = 0; k < 20; ++k) {
      const LitPlace at = random.place(k % 2 == 0 ? size : 10.f);
      double most = 0;
      for (const TestLight& light : lights) {
        for (const Vec3 corner : light.corners) most = std::max(most, light.from(corner, at.P));
      }
      if (!(most > 0.0)) continue;
      ++shining;
      EXPECT_GT(importance(group, at), 0.0);
      for (const TestLight& light : lights) {
        const bool shines = light.from(light.corners[0], at.P) > 0.0;
        if (shines) {
          EXPECT_GT(importance(light.bounds(), at), 0.0);
        }
      }
    }
  }
  EXPECT_GT(shining, 10000);
}

TEST(LightBounds, NothingOverflows) {
  LightBounds bright;
  bright.box.add({0, 0, 0});
  bright.intensity = 3e38;
  for (const LitPlace& at : {LitPlace{{0, 0, 0}}, LitPlace{{1e-30f, 0, 0}, {1, 0, 0}},
                             LitPlace{{1e18f, 1e18f, 1e18f}, {0, 0, 1}}}) {
    EXPECT_TRUE(std::isfinite(importance(bright, at)));
    EXPECT_GT(importance(bright, at), 0.0);
  }
  LightBounds dim = bright;
  dim.intensity = 1e-37;
  dim.box.add({1e18f, 1e18f, 1e18f});
  EXPECT_GT(importance(dim, {{-1e18f, 0, 0}, {0, 0, 1}}), 0.0);
}

}  // namespace
}  // namespace nacre::host
