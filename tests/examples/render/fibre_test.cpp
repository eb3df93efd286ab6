// Fibres: their files, where rays meet them, what a shader reads there, and light through them.
#include "examples/render/fibre.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include "examples/render/builtin_scene.h"
#include "examples/render/bvh.h"
#include "examples/render/camera.h"
#include "examples/render/load_scene.h"
#include "examples/render/mesh.h"
#include "examples/render/render.h"
#include "examples/render/surface.h"
#include "tests/examples/render/scene_samples.h"
#include "tests/examples/render/test_shaders.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

void expect_near(Vec3 a, Vec3 b, float tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Two fibres: one of two pieces, one of one, as a HAIR file; `arrays` as in its header.
std::string hair_file(std::uint32_t arrays = 0x1f, std::uint32_t points = 5) {
  std::string data("HAIR");
  append<std::uint32_t>(data, {2, points, arrays, 2});
  append<float>(data, {0.25f, 0.f, 0.1f, 0.2f, 0.3f});
  data.resize(128, '\0');
  append<std::uint16_t>(data, {2, 1});
  append<float>(data, {0, 0, 0, 0, 1, 0, 0, 2, 0, 5, 0, 0, 5, 3, 0});
  append<float>(data, {0.2f, 0.2f, 0.1f, 0.4f, 0.4f});  // Thickness.
  append<float>(data, {0.5f, 0, 0, 0, 0});              // Transparency.
  for (int i = 0; i < 5; ++i) append<float>(data, {1.f, 0.5f, static_cast<float>(i)});
  return data;
}

class Fibre : public ::testing::Test {
 protected:
  Scene load(const char* name, const std::string& bytes) {
    diagnostics_ = {};
    return load_scene(folder_.write(name, bytes), {}, diagnostics_);
  }
  std::string codes() const {
    std::string all;
    for (const Diagnostic& diagnostic : diagnostics_.all()) all += diagnostic.code + ' ';
    return all;
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
};

TEST_F(Fibre, AHairFileIsRead) {
  const Scene scene = load("wig.hair", hair_file());
  EXPECT_EQ(codes(), "not-rendered ");  // Its transparency.
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.object_name, "wig");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[1].v[0], 1u);
  EXPECT_EQ(mesh.triangles[2].v[0], 3u);
  EXPECT_EQ(mesh.triangles[2].v[1], 4u);
  EXPECT_FLOAT_EQ(mesh.radius[0], 0.1f);
  EXPECT_FLOAT_EQ(mesh.radius[2], 0.05f);
  EXPECT_FLOAT_EQ(mesh.position[4].y, 3.f);
  EXPECT_FLOAT_EQ(mesh.uv[1].y, 0.5f);
  EXPECT_FLOAT_EQ(mesh.uv[4].y, 1.f);
  ASSERT_EQ(mesh.primvars.size(), 1u);
  EXPECT_FLOAT_EQ(mesh.primvars[0].values[14], 4.f);
}

TEST_F(Fibre, WhatAHairFileLacksIsItsHeaders) {
  std::string bare("HAIR");
  append<std::uint32_t>(bare, {2, 6, 2, 2});
  append<float>(bare, {0.25f, 0.f, 0.1f, 0.2f, 0.3f});
  bare.resize(128, '\0');
  for (int i = 0; i < 6; ++i) append<float>(bare, {0.f, static_cast<float>(i), 0.f});
  const Scene scene = load("a.hair", bare);
  EXPECT_EQ(codes(), "");
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 4u);
  EXPECT_FLOAT_EQ(scene.meshes[0].radius[5], 0.125f);
  EXPECT_FLOAT_EQ(scene.meshes[0].primvars[0].values[17], 0.3f);
}

TEST_F(Fibre, WrongHairFilesAreRefused) {
  const std::string good = hair_file();
  const auto refused = [&](const std::string& bytes) {
    EXPECT_TRUE(load("a.hair", bytes).meshes.empty());
    EXPECT_EQ(codes(), "bad-hair ") << diagnostics_.to_string();
  };
  refused("");
  refused("HAIR");
  refused("WOOL" + good.substr(4));
  refused(good.substr(0, good.size() - 1));
  refused(hair_file(0x1d));     // Without points.
  refused(hair_file(0x1f, 4));  // Points of fewer strands.
  refused(hair_file(0x1f, 4'000'000'000u));
  std::string strands = good;
  const std::uint32_t many = 4'294'967'295u;
  std::memcpy(strands.data() + 4, &many, 4);
  refused(strands);
  strands = hair_file(0x1e);  // Strands of 4,294,967,295 pieces each.
  std::memcpy(strands.data() + 16, &many, 4);
  refused(strands);
}

TEST_F(Fibre, PiecesThatCannotBeTracedAreSaid) {
  std::string bytes = hair_file();
  const float nan = NAN;
  std::memcpy(bytes.data() + 128 + 4 + 12 * 2, &nan, 4);  // The end of the second piece.
  EXPECT_EQ(load("a.hair", bytes).meshes.at(0).triangles.size(), 2u);
  EXPECT_NE(codes().find("bad-fibres"), std::string::npos);
  const float nothing[5] = {};
  bytes = hair_file();
  std::memcpy(bytes.data() + 128 + 4 + 60, nothing, sizeof nothing);
  EXPECT_TRUE(load("a.hair", bytes).meshes.empty());
  EXPECT_NE(codes().find("empty-mesh"), std::string::npos);
}

/// The corners of the card as lines: mode, and the accessor of their radius.
std::string lines(const std::string& mode, const std::string& more) {
  return spoiled_card(
      R"({"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "NORMAL": 3}, "indices": 2)",
      R"({"attributes": {"POSITION": 0, "TEXCOORD_0": 1)" + more + R"(}, "mode": )" + mode);
}

TEST_F(Fibre, LinesWithARadius) {
  // The accessor of texture coordinates has as many floats as there are vertices, twice: one of
  // scalars on the same bytes stands in for radii 0, 1, 1, 1.
  const std::string scalar =
      R"({"bufferView": 1, "componentType": 5126, "count": 4, "type": "SCALAR"})";
  const auto with_scalar = [&](std::string text) {
    const std::string last = R"("count": 4, "type": "VEC4"})";
    return text.insert(text.find(last) + last.size(), ", " + scalar);
  };
  folder_.write("card.bin", card_data());
  Scene scene = load("a.gltf", with_scalar(lines("3", R"(, "_RADIUS": 5)")));
  EXPECT_EQ(codes(), "bad-fibres ") << diagnostics_.to_string();  // The first radius is 0.
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_TRUE(scene.meshes[0].is_fibres());
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
  EXPECT_TRUE(scene.meshes[0].primvars.empty());
  scene = load("a.gltf", with_scalar(lines("1", R"(, "_RADIUS": 5)")));  // Two lines apart.
  ASSERT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.meshes[0].triangles.size(), 1u);
  EXPECT_EQ(scene.meshes[0].triangles[0].v[0], 2u);
  scene = load("a.gltf", with_scalar(lines("2", R"(, "_RADIUS": 5)")));  // And back to the first.
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].position.size(), 5u);
  // Half as large under a node that halves.
  std::string half = with_scalar(lines("3", R"(, "_RADIUS": 5)"));
  half.replace(half.find("[1, 1, 1]"), 9, "[.5,.5,.5]");
  half.replace(half.find("[.5,.5,.5]"), 10, "[0.5,0.5,0.5]");
  scene = load("a.gltf", half);
  ASSERT_EQ(scene.meshes.size(), 1u) << diagnostics_.to_string();
  EXPECT_FLOAT_EQ(scene.meshes[0].radius[1], 0.5f);
  // Vectors are no radii, and lines without one no fibres.
  EXPECT_TRUE(load("a.gltf", lines("3", R"(, "_RADIUS": 3)")).meshes.empty());
  EXPECT_NE(codes().find("gltf"), std::string::npos) << codes();
  load("a.gltf", lines("3", ""));
  EXPECT_NE(codes().find("not-triangles"), std::string::npos) << codes();
}

Scene straight(float radius) {
  Scene scene;
  Mesh mesh;
  mesh.object_name = "fibre";
  mesh.position = {{0.f, -2.f, 0.f}, {0.f, 0.f, 0.f}, {0.f, 2.f, 0.f}};
  mesh.radius = {radius, radius, radius};
  mesh.triangles = fibre_pieces({3});
  scene.meshes.push_back(std::move(mesh));
  return scene;
}

// A cylinder about y: a ray along -z at x meets it at z = sqrt(r^2 - x^2).
TEST_F(Fibre, RaysMeetACylinder) {
  const float r = 0.3f;
  const Scene scene = straight(r);
  const Bvh bvh(scene, diagnostics_);
  ASSERT_TRUE(bvh.ok()) << diagnostics_.to_string();
  const SurfaceGeometry geometry(scene);
  const PixelCamera camera(look_at({0, 0, 5}, {}, 0.6f), 8, 8, 1.f);
  Capabilities needs;
  needs.attributes = attribute_tangents | attribute_object_space;
  BatchBuffer buffer(1, 0, 0);
  for (const float x : {-0.29f, -0.1f, 0.f, 0.2f}) {
    for (const float y : {-1.5f, -0.2f, 0.f, 0.7f}) {
      const Ray ray{{x, y, 5.f}, {0.f, 0.f, -1.f}};
      Hit hit;
      bvh.intersect({&ray, 1}, {&hit, 1}, false);
      ASSERT_FALSE(hit.missed()) << x << ' ' << y;
      const float z = std::sqrt(r * r - x * x);
      EXPECT_NEAR(hit.distance, 5.f - z, 1e-4f);
      const SurfacePoint point{hit.mesh, hit.triangle, hit.u, hit.v, {0, 0, 1}, false,
                               0.f,      0.f,          0,     0.f,   hit.normal};
      expect_near(surface_position(scene, point), {x, y, z}, 1e-4f);
      expect_near(surface_normal(scene, point), {x / r, 0.f, z / r}, 2e-3f);
      geometry.fill({&point, 1}, needs, camera, buffer);
      expect_near(host::load(buffer.batch.P, 0), {x, y, z}, 1e-4f);
      expect_near(host::load(buffer.batch.N, 0), {x / r, 0.f, z / r}, 2e-3f);
      expect_near(host::load(buffer.batch.T, 0), {0.f, 1.f, 0.f}, 2e-3f);
      expect_near(host::load(buffer.batch.P, 0) + host::load(buffer.through, 0), {-x, y, -z},
                  2e-3f);
    }
  }
  const Ray past{{0.31f, 0.f, 5.f}, {0.f, 0.f, -1.f}};
  Hit hit;
  bvh.intersect({&past, 1}, {&hit, 1}, false);
  EXPECT_TRUE(hit.missed());
}

/// Sends light straight on.
class ClearShader final : public LambertShader {
 public:
  ClearShader() : LambertShader({1.f, 1.f, 1.f}) {}
  Capabilities capabilities() const override {
    Capabilities c;
    c.only_delta = true;
    return c;
  }
  void sample(const ShadingBatch& batch, const void*, Lanes3, SampleLanes out) const override {
    for (std::size_t i = 0; i < batch.count; ++i) {
      store(out.wi, i, -load(batch.wo, i));
      store(out.weight, i, {1.f, 1.f, 1.f});
      out.pdf[i] = 1.f;
      out.flags[i] = sample_valid | sample_delta;
    }
  }
};

// What goes through a fibre meets it once, and goes on behind it.
TEST_F(Fibre, LightGoesThroughAtOnce) {
  Scene scene = straight(0.3f);
  scene.meshes.push_back(make_sphere("ball", {0.f, 0.f, -3.f}, 1.f, 24));
  const ClearShader clear;
  const LambertShader glowing({0.f, 0.f, 0.f}, {2.f, 3.f, 4.f});
  const Environment sky = Environment::constant({0.f, 0.f, 0.f});
  RenderSettings s;
  s.width = s.height = 9;
  s.samples = 16;
  s.max_depth = 1;  // One event each is enough.
  s.strategy = Strategy::bsdf_only;
  const auto film =
      render({&scene, {&clear, &glowing}, &sky, look_at({0, 0, 5}, {}, 0.1f)}, s, diagnostics_);
  ASSERT_TRUE(film) << diagnostics_.to_string();
  for (const Vec3 rgb : film->pixels()) {
    EXPECT_FLOAT_EQ(rgb.x, 2.f);
    EXPECT_FLOAT_EQ(rgb.z, 4.f);
  }
}

// As of any convex white object: see Furnace in integrator_test.cpp.
TEST_F(Fibre, AWhiteFibreVanishesInAUniformSky) {
  const Scene scene = straight(0.5f);
  const LambertShader white({1.f, 1.f, 1.f});
  const Environment sky = Environment::constant({1.f, 1.f, 1.f});
  RenderSettings s;
  s.width = s.height = 32;
  s.samples = 16;
  s.max_depth = 1;
  for (const Strategy strategy : {Strategy::bsdf_only, Strategy::multiple_importance}) {
    s.strategy = strategy;
    const auto film =
        render({&scene, {&white}, &sky, look_at({3, 1, 5}, {}, 0.8f)}, s, diagnostics_);
    ASSERT_TRUE(film) << diagnostics_.to_string();
    double sum = 0.0;
    for (const Vec3 rgb : film->pixels()) sum += rgb.y;
    const double mean = sum / static_cast<double>(film->pixels().size());
    EXPECT_NEAR(mean, 1.0, strategy == Strategy::bsdf_only ? 1e-6 : 1e-2);
  }
}

}  // namespace
}  // namespace nacre::host
