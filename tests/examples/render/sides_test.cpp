// The two sides of surfaces, what the camera does not see, and holdouts.
#include <gtest/gtest.h>

#include <numbers>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/render.h"
#include "examples/render/surface.h"
#include "tests/examples/render/statistics.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

const Vec3 red = {1.f, 0.f, 0.f}, green = {0.f, 1.f, 0.f}, black = {};

/// A small picture through a lens so narrow that all of it shows one spot.
class Sides : public ::testing::Test {
 protected:
  Sides() {
    settings_.width = settings_.height = 4;
    settings_.samples = 4;
    settings_.max_depth = 1;
  }

  Film film(Vec3 from, Vec3 to) {
    Diagnostics diagnostics;
    const RenderInput input{&scene_, shaders_, sky_, look_at(from, to, 1e-3f), back_shaders_};
    std::optional<Film> film = render(input, settings_, diagnostics);
    EXPECT_TRUE(film) << diagnostics.to_string();
    return film ? *std::move(film) : Film(4, 4);
  }

  void expect(const Film& film, Vec3 rgb, float alpha = 1.f) {
    for (int i = 0; i < 16; ++i) {
      const Vec3 seen = film.mean(i % 4, i / 4);
      EXPECT_EQ(seen.x, rgb.x);
      EXPECT_EQ(seen.y, rgb.y);
      EXPECT_EQ(seen.z, rgb.z);
      EXPECT_EQ(film.alpha(i % 4, i / 4), alpha);
    }
  }

  /// A wall in the plane z = 0 whose front looks along +z.
  Mesh& add_wall(const Shader& front, const Shader* back = nullptr) {
    scene_.meshes.push_back(make_quad("wall", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
    shaders_.push_back(&front);
    back_shaders_.push_back(back);
    return scene_.meshes.back();
  }
  /// One at z = 4 that looks back at it.
  void add_mirror() {
    scene_.meshes.push_back(make_quad("mirror", {1, -1, 4}, {-2, 0, 0}, {0, 2, 0}));
    shaders_.push_back(&mirror_);
    back_shaders_.push_back(nullptr);
  }

  Scene scene_;
  std::vector<const Shader*> shaders_, back_shaders_;
  const Environment blue_ = Environment::constant({0.f, 0.f, 1.f});
  const Environment* sky_ = &blue_;
  RenderSettings settings_;
  LambertShader glows_red_{black, red}, glows_green_{black, green};
  MirrorShader mirror_{{1.f, 1.f, 1.f}};
};

TEST_F(Sides, EachShowsItsOwnShader) {
  add_wall(glows_red_, &glows_green_);
  expect(film({0.1f, 0, 3}, {}), red);
  expect(film({0.1f, 0, -3}, {}), green);
  back_shaders_.clear();
  expect(film({0.1f, 0, -3}, {}), red);
}

TEST_F(Sides, OpacityIsOfTheSideThatIsMet) {
  const LambertShader clear(black, red, black);
  add_wall(glows_red_, &clear);
  expect(film({0.1f, 0, 3}, {}), red);
  expect(film({0.1f, 0, -3}, {}), {0.f, 0.f, 1.f});
}

/// A lamp that is red above and glows green, three times as bright, on the floor below
/// it: the green is the form factor of a rectangle (Howell, "A Catalog of Radiation Heat
/// Transfer Configuration Factors", B-3), by every strategy, and there is no red.
TEST_F(Sides, LightOfTheirOwn) {
  scene_.meshes.push_back(make_quad("floor", {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
  scene_.meshes.push_back(make_quad("lamp", {-0.5f, 1, 0.75f}, {1, 0, 0}, {0, 0, -1.5f}));
  ASSERT_GT(surface_normal(scene_, {.mesh = 1}).y, 0.f);
  const LambertShader white({1.f, 1.f, 1.f}), bright_green(black, {0.f, 3.f, 0.f}), dark(black);
  shaders_ = {&white, &glows_red_};
  back_shaders_ = {nullptr, &bright_green};
  sky_ = nullptr;
  settings_.samples = 1024;
  settings_.sampler = SamplerKind::independent;
  const double x = 0.5, y = 0.75, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  const double corner =
      (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * std::numbers::pi);
  for (const Strategy strategy :
       {Strategy::bsdf_only, Strategy::light_only, Strategy::multiple_importance}) {
    settings_.strategy = strategy;
    const Film seen = film({4.f, 0.7f, 0.f}, {});
    EXPECT_LT(z_score(estimate(seen, 1), 3 * 4 * corner), 4);
    EXPECT_EQ(estimate(seen, 0).mean, 0.0);
  }
  // And where the back is dark, none at all.
  back_shaders_[1] = &dark;
  expect(film({4.f, 0.7f, 0.f}, {}), black);
}

TEST_F(Sides, TheCameraDoesNotSeeTheBackOfOneSidedMeshes) {
  add_wall(glows_red_, &glows_green_).two_sided = false;
  expect(film({0.1f, 0, 3}, {}), red);
  expect(film({0.1f, 0, -3}, {}), {0.f, 0.f, 1.f});
}

TEST_F(Sides, OtherRaysMeetTheBackOfOneSidedMeshes) {
  Mesh& wall = add_wall(glows_red_, &glows_green_);
  wall = make_quad("wall", {1, -1, 0}, {-2, 0, 0}, {0, 2, 0});
  wall.two_sided = false;
  add_mirror();
  // From between them into the mirror, which looks at that back.
  expect(film({0, 0, 2}, {0, 0, 4}), green);
}

TEST_F(Sides, MattesAreHoles) {
  add_wall(glows_red_).matte = true;
  expect(film({0.1f, 0, 3}, {}), black, 0.f);
  // Beside it there is the sky, and the film still has an alpha.
  expect(film({0.1f, 0, 3}, {5, 0, 0}), {0.f, 0.f, 1.f});
}

TEST_F(Sides, MattesAreMetByOtherRays) {
  add_wall(glows_red_).matte = true;
  add_mirror();
  expect(film({0, 0, 2}, {0, 0, 4}), red);
}

TEST_F(Sides, MattesHoldOutOnlyWhereTheyArePresent) {
  const LambertShader clear(black, red, black);
  add_wall(clear).matte = true;
  expect(film({0.1f, 0, 3}, {}), {0.f, 0.f, 1.f});
}

TEST_F(Sides, WhatIsNotIlluminatedStaysDark) {
  const LambertShader white({1.f, 1.f, 1.f});
  add_wall(white).illuminated = false;
  scene_.meshes.push_back(make_quad_light("lamp", {1, -1, 4}, {-2, 0, 0}, {0, 2, 0}, red));
  shaders_.push_back(nullptr);
  back_shaders_.push_back(nullptr);
  for (const Strategy strategy :
       {Strategy::bsdf_only, Strategy::light_only, Strategy::multiple_importance}) {
    settings_.strategy = strategy;
    expect(film({0.1f, 0, 3}, {}), black);
    scene_.meshes[0].illuminated = true;
    EXPECT_GT(film({0.1f, 0, 3}, {}).mean(0, 0).z, 0.f);
    scene_.meshes[0].illuminated = false;
  }
}

TEST_F(Sides, WhatNothingSeesIsNoLight) {
  const LambertShader white({1.f, 1.f, 1.f});
  sky_ = nullptr;
  add_wall(white);
  scene_.meshes.push_back(make_quad("glow", {1, -1, 4}, {-2, 0, 0}, {0, 2, 0}));
  shaders_.push_back(&glows_red_);
  back_shaders_.push_back(nullptr);
  EXPECT_GT(film({0.1f, 0, 3}, {}).mean(0, 0).x, 0.f);
  scene_.meshes[1].visible_to = 0;
  expect(film({0.1f, 0, 3}, {}), black);
}

}  // namespace
}  // namespace nacre::host
