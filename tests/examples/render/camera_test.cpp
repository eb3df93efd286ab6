// Cameras and rays that nothing can be traced along.
#include "examples/render/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "examples/render/builtin_scene.h"
#include "examples/render/bvh.h"
#include "examples/render/render.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
const float not_a_number = std::nanf("");

TEST(Camera, WhatMakesNoRaysIsAnErrorBeforeTracing) {
  const Camera good = make_builtin_scene().cameras[0].camera;
  Diagnostics none;
  EXPECT_TRUE(check_camera(good, none));
  EXPECT_TRUE(none.all().empty());
  std::vector<Camera> all;
  const auto add = [&](auto change) { change(all.emplace_back(good)); };
  for (const float x : {infinite, -infinite, not_a_number, 1e38f}) {
    add([x](Camera& c) { c.position.y = x; });
    add([x](Camera& c) { c.lens_radius = x; });
    add([x](Camera& c) { c.vertical_fov = x; });
    add([x](Camera& c) { c.forward.x = x; });
    add([x](Camera& c) { c.up.z = x; });
    add([x](Camera& c) { c.lens_radius = 0.1f, c.focus_distance = x; });
  }
  add([](Camera& c) { c.lens_radius = -1.f; });
  add([](Camera& c) { c.lens_radius = 1.f, c.focus_distance = 0.f; });
  add([](Camera& c) { c.vertical_fov = 0.f; });
  add([](Camera& c) { c.vertical_fov = 3.1415927f; });
  add([](Camera& c) { c.right = {}; });
  Scene scene = make_builtin_scene();
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  RenderSettings settings;
  settings.width = settings.height = 8;
  settings.samples = 1;
  for (const Camera& camera : all) {
    Diagnostics diagnostics;
    EXPECT_FALSE(
        render({&scene, {&grey, &grey, &grey, nullptr}, &sky, camera}, settings, diagnostics));
    EXPECT_TRUE(diagnostics.has_errors());
    EXPECT_EQ(diagnostics.all()[0].code, "bad-camera");
  }
}

// At the ends of what is allowed there is a picture, of finite numbers.
TEST(Camera, TheLargestThatAreAllowed) {
  Scene scene = make_builtin_scene();
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  RenderSettings settings;
  settings.width = settings.height = 16;
  settings.samples = 4;
  for (const float far : {1e9f, 1e18f}) {
    for (const float fov : {smallest_fov, 0.5f, largest_fov}) {
      for (const float lens : {0.f, 1e-18f, 1.f, 1e18f}) {
        Camera camera = look_at({far, far, far}, {0.f, 1.f, 0.f}, fov);
        camera.lens_radius = lens;
        camera.focus_distance = lens > 1.f ? 1e18f : 1.f;
        Diagnostics diagnostics;
        const auto film =
            render({&scene, {&grey, &grey, &grey, nullptr}, &sky, camera}, settings, diagnostics);
        ASSERT_TRUE(film) << diagnostics.to_string();
        for (const Vec3 rgb : film->pixels()) EXPECT_TRUE(is_finite(rgb));
      }
    }
  }
}

// Embree's assertions end the process where its traversal meets such rays.
TEST(Bvh, RaysThatCannotBeTracedMeetNothing) {
  Scene scene = make_builtin_scene();
  Diagnostics diagnostics;
  const Bvh bvh(scene, diagnostics);
  const Ray good = {{0.f, 5.f, 0.f}, {0.f, -1.f, 0.f}};
  std::vector<Ray> rays;
  for (const float x : {infinite, -infinite, not_a_number, 1e38f, 3e18f}) {
    for (int i = 0; i < 40; ++i) {
      rays.push_back(good);
      rays.push_back({{x, 5.f, 0.f}, {0.f, -1.f, 0.f}});
      rays.push_back({{0.f, 5.f, 0.f}, {0.f, x, 0.f}});
      rays.push_back({{0.f, 5.f, 0.f}, {0.f, -1.f, x}});
      rays.push_back({{0.f, 5.f, 0.f}, {0.f, 0.f, 0.f}});
      rays.push_back({{0.f, 5.f, 0.f}, {0.f, -1.f, 0.f}, not_a_number});
      rays.push_back({{0.f, 5.f, 0.f}, {0.f, -1.f, 0.f}, -1.f});
    }
  }
  std::vector<Hit> hits(rays.size());
  std::vector<std::uint8_t> blocked(rays.size());
  for (const bool coherent : {false, true}) {
    bvh.intersect(rays, hits, coherent);
    for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(hits[i].missed(), i % 7 != 0) << i;
  }
  bvh.occluded(rays, blocked);
  for (std::size_t i = 0; i < rays.size(); ++i) EXPECT_EQ(blocked[i], i % 7 == 0 ? 1 : 0) << i;
}

}  // namespace
}  // namespace nacre::host
