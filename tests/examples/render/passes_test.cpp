// Passes: light adds up to the picture and is where theory has it; what is seen is as geometry
// says.
#include "examples/render/passes.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/cryptomatte.h"
#include "examples/render/render.h"
#include "tests/examples/render/test_shaders.h"

namespace nacre::host {
namespace {

RenderSettings settings(std::initializer_list<const char*> names) {
  RenderSettings s;
  s.width = s.height = 16;
  s.samples = 64;
  s.threads = 2;
  for (const char* name : names) {
    const auto pass = find_pass(name);
    EXPECT_TRUE(pass) << name;
    if (pass) s.passes.passes.push_back(*pass);
  }
  return s;
}

Film rendered(const RenderInput& input, const RenderSettings& s) {
  Diagnostics diagnostics;
  std::optional<Film> film = render(input, s, diagnostics);
  EXPECT_TRUE(film) << diagnostics.to_string();
  return film ? *std::move(film) : Film(s.width, s.height);
}

/// A channel, as "direct.R".
const std::vector<float>& plane(const Film& film, const std::string& channel) {
  const auto& all = film.passes.channels;
  const auto at = std::ranges::find(all, channel) - all.begin();
  return film.passes.planes.at(static_cast<std::size_t>(at));
}

double mean(const std::vector<float>& plane) {
  double sum = 0;
  for (const float x : plane) sum += static_cast<double>(x);
  return sum / static_cast<double>(plane.size());
}

// Between two large plates of albedo a under a lamp that each sees the other of, light is scattered
// again and again; whatever it does, it is in one of the passes.
TEST(Passes, LightAddsUpToThePicture) {
  Scene scene;
  scene.meshes.push_back(make_quad("floor", {-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
  scene.meshes.push_back(make_quad("wall", {-1, 0, -2}, {2, 0, 0}, {0, 2, 0}));
  scene.meshes.push_back(
      make_quad_light("lamp", {-0.5f, 2.f, -0.75f}, {1.f, 0, 0}, {0, 0, 1.5f}, {3.f, 2.f, 1.f}));
  scene.meshes.push_back(make_sphere("ball", {0.f, 0.6f, 0.f}, 0.5f, 24));
  const LambertShader grey({0.6f, 0.3f, 0.8f}), glowing({0.5f, 0.5f, 0.5f}, {0.2f, 0.1f, 0.f});
  const Environment sky = Environment::constant({0.5f, 0.4f, 0.3f});
  RenderSettings s = settings({"emission", "background", "direct", "indirect", "direct_diffuse",
                               "indirect_diffuse", "direct_glossy", "indirect_mirror"});
  s.passes.groups = {{"lamp", "sky"}, {2, 2, 0, 2}, {}, 1};
  for (std::size_t k = 0; k < 3; ++k) s.passes.passes.push_back(group_pass(s.passes.groups, k));
  const Film film = rendered({&scene,
                              {&grey, &grey, nullptr, &glowing},
                              &sky,
                              look_at({0.f, 2.f, 6.f}, {0.f, 1.f, 0.f}, 0.8f)},
                             s);
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    const float whole = film.pixels()[i].x;
    const auto at = [&](const char* name) { return plane(film, std::string(name) + ".R")[i]; };
    const float tolerance = 1e-5f * whole;
    EXPECT_NEAR(at("emission") + at("background") + at("direct") + at("indirect"), whole,
                tolerance);
    EXPECT_NEAR(at("light_lamp") + at("light_sky") + at("light_other"), whole, tolerance);
    EXPECT_NEAR(at("direct_diffuse"), at("direct"), tolerance);
    EXPECT_NEAR(at("indirect_diffuse"), at("indirect"), tolerance);
    EXPECT_EQ(at("direct_glossy"), 0.f);
    EXPECT_EQ(at("indirect_mirror"), 0.f);
  }
  for (const char* name : {"emission.R", "background.R", "direct.R", "indirect.R", "light_lamp.R",
                           "light_sky.R", "light_other.R"}) {
    EXPECT_GT(mean(plane(film, name)), 1e-3) << name;
  }
  // The ball glows no blue, and nothing else is in the group of the rest.
  EXPECT_EQ(mean(plane(film, "light_other.B")), 0.0);
}

// What is convex sees nothing of itself: under an even sky all its light is direct, and a times as
// much as the sky's.
TEST(Passes, ConvexBodyHasDirectLightOnly) {
  Scene scene;
  scene.meshes.push_back(make_sphere("ball", {}, 1.f, 48));
  const LambertShader grey({0.5f, 0.25f, 0.75f});
  const Environment sky = Environment::constant({2.f, 2.f, 2.f});
  RenderSettings s = settings({"direct_diffuse", "indirect", "background"});
  s.max_depth = 4;
  const Film film =
      rendered({&scene, {&grey}, &sky, look_at({0, 0, 4.f}, {}, 0.2f)}, s);  // Within the ball.
  EXPECT_NEAR(mean(plane(film, "direct_diffuse.R")), 1.0, 2e-2);
  EXPECT_NEAR(mean(plane(film, "direct_diffuse.B")), 1.5, 3e-2);
  EXPECT_LT(mean(plane(film, "indirect.R")), 2e-3);  // It is a polyhedron.
  EXPECT_EQ(mean(plane(film, "background.R")), 0.0);
}

TEST(Passes, MirrorsShowLightThatIsScatteredOnce) {
  Scene scene;
  scene.meshes.push_back(make_quad("mirror", {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}));
  const MirrorShader mirror({0.5f, 0.5f, 0.5f});
  const Environment sky = Environment::constant({2.f, 2.f, 2.f});
  const Film film = rendered({&scene, {&mirror}, &sky, look_at({0, 0, 4.f}, {}, 0.2f)},
                             settings({"direct_mirror", "direct", "indirect"}));
  EXPECT_FLOAT_EQ(static_cast<float>(mean(plane(film, "direct.G"))), 1.f);
  EXPECT_FLOAT_EQ(static_cast<float>(mean(plane(film, "direct_mirror.G"))), 1.f);
  EXPECT_EQ(mean(plane(film, "indirect.G")), 0.0);
}

// A card in the plane z = 0, from 4 away: depth everywhere 4, x and y as similar triangles say.
TEST(Passes, WhatIsSeenIsWhereItIs) {
  Scene scene;
  scene.meshes.push_back(make_quad("card", {-5, -5, 0}, {10, 0, 0}, {0, 10, 0}));
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  RenderSettings s = settings({"depth", "position", "normal", "uv", "mesh_id"});
  const Film film = rendered({&scene, {&grey}, nullptr, look_at({0, 0, 4.f}, {}, 0.5f)}, s);
  const float pixel = 2.f * 4.f * std::tan(0.25f) / 16.f;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const std::size_t i = film.index(x, y);
      EXPECT_NEAR(plane(film, "depth.Z")[i], 4.f, 1e-5f);
      const float across = (static_cast<float>(x) - 7.5f) * pixel;
      EXPECT_NEAR(plane(film, "position.X")[i], across, 0.05f * pixel);
      EXPECT_NEAR(plane(film, "uv.X")[i], across / 10.f + 0.5f, 0.005f * pixel);
      EXPECT_NEAR(plane(film, "position.Y")[i], (7.5f - static_cast<float>(y)) * pixel,
                  0.05f * pixel);
      EXPECT_EQ(plane(film, "normal.Z")[i], 1.f);
      EXPECT_EQ(plane(film, "mesh_id.V")[i], 1.f);
    }
  }
}

TEST(Passes, MotionIsOfTheImage) {
  Scene scene;
  Mesh card = make_quad("card", {-5, -5, 0}, {10, 0, 0}, {0, 10, 0});
  Affine to_the_right;
  to_the_right.origin = {0.25f, 0.5f, 0.f};
  card.instances = {Motion({{0.f, 1.f, {Affine{}, to_the_right}}})};
  card.position_object.clear();
  scene.meshes.push_back(card);
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  RenderSettings s = settings({"motion"});
  s.shutter_close = 1.f;
  const Film film = rendered({&scene, {&grey}, nullptr, look_at({0, 0, 4.f}, {}, 0.5f)}, s);
  const float pixel = 2.f * 4.f * std::tan(0.25f) / 16.f;
  for (std::size_t i = 0; i < film.pixels().size(); ++i) {
    EXPECT_NEAR(plane(film, "motion.X")[i], 0.25f / pixel, 1e-3f);
    EXPECT_NEAR(plane(film, "motion.Y")[i], -0.5f / pixel, 1e-3f);  // Down the image.
  }
}

// The vectors for MurmurHash3_x86_32 with seed 0 that are around (Wikipedia, "MurmurHash").
TEST(Cryptomatte, HashesAsMurmurHash3Does) {
  EXPECT_EQ(matte_hash(""), 0u);
  EXPECT_EQ(matte_hash("test"), 0xba6bd213u);
  EXPECT_EQ(matte_hash("Hello, world!"), 0xc0363e43u);
  EXPECT_EQ(matte_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

TEST(Cryptomatte, IdsAreNormalFloats) {
  EXPECT_EQ(std::bit_cast<std::uint32_t>(matte_id(0x3f800000u)), 0x3f800000u);
  for (const std::uint32_t hash : {0u, 0x7fffffffu, 0xff812345u, 0x00012345u, 0x80000000u}) {
    EXPECT_TRUE(std::isnormal(matte_id(hash))) << hash;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(matte_id(hash)) ^ hash, 1u << 23) << hash;
  }
}

// Two halves of a picture: each pixel shows one name, the middle one both by what it has of them.
TEST(Cryptomatte, SharesAreWhatAPixelHas) {
  Scene scene;
  scene.meshes.push_back(make_quad("left", {-5, -5, 0}, {5, 0, 0}, {0, 10, 0}));
  scene.meshes.push_back(make_quad("right", {0, -5, 0}, {5, 0, 0}, {0, 10, 0}));
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  RenderSettings s = settings({});
  s.width = 15;
  s.passes.object_mattes = true;
  const Film film = rendered({&scene, {&grey, &grey}, nullptr, look_at({0, 0, 4.f}, {}, 0.5f)}, s);
  const Mattes& mattes = film.passes.mattes.at(0);
  EXPECT_EQ(mattes.planes[0][film.index(2, 5)], matte_id(matte_hash("left")));
  EXPECT_EQ(mattes.planes[1][film.index(2, 5)], 1.f);
  EXPECT_EQ(mattes.planes[0][film.index(12, 5)], matte_id(matte_hash("right")));
  const std::size_t middle = film.index(7, 5);
  EXPECT_NEAR(mattes.planes[1][middle], 0.5f, 0.05f);
  EXPECT_NEAR(mattes.planes[1][middle] + mattes.planes[3][middle], 1.f, 1e-6f);
}

}  // namespace
}  // namespace nacre::host
