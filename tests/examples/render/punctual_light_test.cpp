// Lights that no ray meets: what points see of them, what scenes say of them, what they light.
#include "examples/render/punctual_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "examples/render/builtin_scene.h"
#include "examples/render/camera.h"
#include "examples/render/load_scene.h"
#include "examples/render/mesh.h"
#include "examples/render/render.h"
#include "tests/examples/render/scene_samples.h"
#include "tests/examples/render/test_shaders.h"
#include "tests/support/temporary_folder.h"

namespace nacre::host {
namespace {

using Kind = PunctualLight::Kind;

struct Seen {
  Vec3 intensity, direction;
  float distance;
};

Seen seen_from(const PunctualLight& light, Vec3 p) {
  BatchBuffer buffer(1, 0, 0);
  buffer.batch.count = 1;
  store(buffer.batch.P, 0, p);
  const LightLanes out{buffer.rgb, buffer.wi, buffer.value.pdf};
  PunctualShader(light).light(buffer.batch, out);
  return {load(out.intensity, 0), load(out.direction, 0), out.distance[0]};
}

TEST(Punctual, PointsFallOffBySquares) {
  const PunctualLight light{
      .kind = Kind::point, .color = {8, 4, 2}, .position = {0, 3, 4}, .direction = {}};
  const Seen seen = seen_from(light, {0, 0, 0});
  EXPECT_FLOAT_EQ(seen.intensity.x, 8.f / 25.f);
  EXPECT_FLOAT_EQ(seen.intensity.z, 2.f / 25.f);
  EXPECT_FLOAT_EQ(seen.direction.y, 0.6f);
  EXPECT_FLOAT_EQ(seen.distance, 5.f);
  EXPECT_EQ(seen_from(light, {0, 3, 4}).intensity.x, 0.f);  // It is there.
}

// KHR_lights_punctual: max(min(1 - (d / range)^4, 1), 0) / d^2.
TEST(Punctual, RangesEnd) {
  const PunctualLight light{
      .kind = Kind::point, .color = {1, 1, 1}, .position = {}, .direction = {}, .range = 2.f};
  EXPECT_FLOAT_EQ(seen_from(light, {1, 0, 0}).intensity.x, 15.f / 16.f);
  EXPECT_EQ(seen_from(light, {2, 0, 0}).intensity.x, 0.f);
  EXPECT_EQ(seen_from(light, {9, 0, 0}).intensity.x, 0.f);
}

TEST(Punctual, SpotsAreCones) {
  const float inner = std::cos(0.3f), outer = std::cos(0.6f);
  const PunctualLight light{.kind = Kind::spot,
                            .color = {1, 1, 1},
                            .position = {},
                            .direction = {0, 0, -1},
                            .inner_cos = inner,
                            .outer_cos = outer};
  const auto at = [&](float angle) {
    return seen_from(light, {std::sin(angle), 0, -std::cos(angle)}).intensity.x;
  };
  EXPECT_NEAR(at(0.f), 1.f, 1e-6f);
  EXPECT_NEAR(at(0.29f), 1.f, 1e-5f);
  const float half = 0.5f * (inner + outer);
  EXPECT_NEAR(at(std::acos(half)), 0.25f, 1e-4f);
  EXPECT_EQ(at(0.61f), 0.f);
  EXPECT_EQ(at(3.f), 0.f);
}

Mesh floor() {
  Mesh mesh;
  mesh.object_name = "floor";
  mesh.position = {{-9, 0, -9}, {-9, 0, 9}, {9, 0, 9}, {9, 0, -9}};
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  Diagnostics diagnostics;
  finish_mesh(mesh, {}, diagnostics);
  return mesh;
}

Film lit(const Scene& scene, const std::vector<const Shader*>& shaders, const PunctualLight& light,
         Strategy strategy) {
  const PunctualShader shader(light);
  RenderSettings s;
  s.width = s.height = 4;
  s.samples = 4;
  s.max_depth = 1;
  s.strategy = strategy;
  RenderInput input{&scene, shaders, nullptr, look_at({0, 5, 5}, {}, 0.001f)};
  input.lights = {&shader};
  Diagnostics diagnostics;
  const auto film = render(input, s, diagnostics);
  EXPECT_TRUE(film) << diagnostics.to_string();
  return film ? *film : Film(4, 4);
}

// A diffuse floor below a light: albedo / pi times cosine times intensity over squared distance.
TEST(Punctual, LightsAFloor) {
  Scene scene;
  scene.meshes.push_back(floor());
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  const PunctualLight light{
      .kind = Kind::point, .color = {100, 50, 0}, .position = {3, 4, 0}, .direction = {}};
  for (const Strategy strategy : {Strategy::light_only, Strategy::multiple_importance}) {
    const Film film = lit(scene, {&grey}, light, strategy);
    const float expected = 0.5f / std::numbers::pi_v<float> * 0.8f * 100.f / 25.f;
    for (const Vec3 rgb : film.pixels()) {
      EXPECT_NEAR(rgb.x, expected, 2e-3f * expected);
      EXPECT_NEAR(rgb.y, 0.5f * expected, 2e-3f * expected);
      EXPECT_EQ(rgb.z, 0.f);
    }
  }
  const PunctualLight sun{
      .kind = Kind::directional, .color = {2, 2, 2}, .position = {}, .direction = {0.6f, -0.8f, 0}};
  const Film film = lit(scene, {&grey}, sun, Strategy::multiple_importance);
  EXPECT_NEAR(film.pixels()[5].x, 0.5f / std::numbers::pi_v<float> * 0.8f * 2.f, 1e-5f);
}

// What is between shades; what is behind the light does not.
TEST(Punctual, ThrowsShadows) {
  Scene scene;
  scene.meshes.push_back(floor());
  scene.meshes.push_back(make_sphere("ball", {0, 8, 0}, 1.f, 24));
  const LambertShader grey({0.5f, 0.5f, 0.5f});
  PunctualLight light{
      .kind = Kind::point, .color = {100, 100, 100}, .position = {0, 6, 0}, .direction = {}};
  EXPECT_GT(lit(scene, {&grey, &grey}, light, Strategy::multiple_importance).pixels()[5].x, 0.1f);
  light.position.y = 10.f;
  EXPECT_EQ(lit(scene, {&grey, &grey}, light, Strategy::multiple_importance).pixels()[5].x, 0.f);
}

// A light of an animated node, at the moment that the shutter opens.
TEST(Punctual, AMovingLightStandsWhereItIsAtFirst) {
  TemporaryFolder folder;
  std::string data = card_data();  // And two times, and two places.
  append<float>(data, {0, 2, 0, 0, 3, 8, 0, 3});
  folder.write("card.bin", data);
  std::string text = spoiled_card(R"({"camera": 0, "translation": [0.5, 0.5, 3]})",
                                  R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})");
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace(R"("byteLength": 204)", R"("byteLength": 236)");
  replace(R"({"buffer": 0, "byteOffset": 140, "byteLength": 64}])",
          R"({"buffer": 0, "byteOffset": 140, "byteLength": 64},
             {"buffer": 0, "byteOffset": 204, "byteLength": 8},
             {"buffer": 0, "byteOffset": 212, "byteLength": 24}])");
  replace(R"("count": 4, "type": "VEC4"}])", R"("count": 4, "type": "VEC4"},
      {"bufferView": 5, "componentType": 5126, "count": 2, "type": "SCALAR"},
      {"bufferView": 6, "componentType": 5126, "count": 2, "type": "VEC3"}],
    "animations": [{"samplers": [{"input": 5, "output": 6}],
      "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}]}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point"}]}})");
  Diagnostics diagnostics;
  const Scene scene =
      load_scene(folder.write("a.gltf", text), {}, diagnostics, {.open = 0.5, .close = 1.5});
  ASSERT_EQ(scene.lights.size(), 1u) << diagnostics.to_string();
  EXPECT_FLOAT_EQ(scene.lights[0].position.x, 2.f);
  EXPECT_FLOAT_EQ(scene.lights[0].position.z, 3.f);
  ASSERT_EQ(diagnostics.all().size(), 1u) << diagnostics.to_string();
  EXPECT_EQ(diagnostics.all()[0].code, "light-stands");
}

TEST(Punctual, GltfLightsAreRead) {
  TemporaryFolder folder;
  folder.write("card.bin", card_data());
  const auto load = [&](const std::string& light, Diagnostics& diagnostics) {
    std::string text = spoiled_card(
        R"({"camera": 0, "translation": [0.5, 0.5, 3]})",
        R"({"translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}})");
    text.insert(1, R"("extensions": {"KHR_lights_punctual": {"lights": [)" + light + "]}},");
    return load_scene(folder.write("a.gltf", text), {}, diagnostics);
  };
  Diagnostics diagnostics;
  const Scene scene = load(
      R"({"type": "spot", "color": [1, 0.5, 0], "intensity": 4, "range": 7,
          "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}})",
      diagnostics);
  EXPECT_EQ(diagnostics.to_string(), "");
  ASSERT_EQ(scene.lights.size(), 1u);
  const PunctualLight& light = scene.lights[0];
  EXPECT_EQ(light.kind, Kind::spot);
  EXPECT_FLOAT_EQ(light.color.y, 2.f);
  EXPECT_FLOAT_EQ(light.position.y, 2.f);
  EXPECT_FLOAT_EQ(light.direction.z, -1.f);
  EXPECT_FLOAT_EQ(light.range, 7.f);
  EXPECT_FLOAT_EQ(light.inner_cos, std::cos(0.25f));
  for (const char* wrong :
       {R"({})", R"({"type": "torch"})", R"({"type": "point", "intensity": -1})",
        R"({"type": "point", "color": [1, 1]})",
        R"({"type": "spot", "spot": {"outerConeAngle": 4}})",
        R"({"type": "point", "intensity": 1e30, "color": [1e30, 1, 1]})"}) {
    Diagnostics said;
    EXPECT_TRUE(load(wrong, said).meshes.empty()) << wrong;
    EXPECT_EQ(said.error_count(), 1u) << wrong << said.to_string();
  }
}

}  // namespace
}  // namespace nacre::host
