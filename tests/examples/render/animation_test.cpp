// Animations and instances of glTF files, right and wrong ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "examples/render/bvh.h"
#include "tests/examples/render/card_fixture.h"

namespace nacre::host {
namespace {

/// Behind the card's data: 204-215 times 1 2 4; 216-251 three places; 252-299 three quaternions,
/// about z by 0, 90 and 180 degrees; 300-407 the places with tangents; 408-419 broken times;
/// 420-455 places that are not finite.
std::string moving_data() {
  std::string data = card_data();
  const float half = std::numbers::sqrt2_v<float> / 2, nan = std::nanf("");
  append<float>(data, {1, 2, 4});
  append<float>(data, {0, 0, 0, 10, 0, 0, 10, 8, 0});
  append<float>(data, {0, 0, 0, 1, 0, 0, half, half, 0, 0, 1, 0});
  append<float>(
      data, {0, 0, 0, 0, 0, 0, 3, 0, 0, 3, 0, 0, 10, 0, 0, 0, 0, 0, 0, 0, 0, 10, 8, 0, 0, 0, 0});
  append<float>(data, {1, 1, 4});
  append<float>(data, {0, 0, 0, 1, nan, 0, 0, 0, 0});
  return data;
}

/// The card with an animation; accessors from 5: times, places, quaternions, tangents, broken
/// times, places that are not finite, scalar bytes.
std::string moving_card(std::string_view channels, std::string_view samplers,
                        std::string_view node = "") {
  std::string text = spoiled_card("\"byteLength\": 204", "\"byteLength\": 456");
  const auto instead = [&text](std::string_view from, std::string_view to) {
    text.replace(text.find(from), from.size(), to);
  };
  if (!node.empty()) instead("\"scale\": [1, 1, 1]", node);
  put_before(text, "\"scenes\"",
             "\"animations\": [{\"channels\": [" + std::string(channels) + "], \"samplers\": [" +
                 std::string(samplers) + "]}],\n  ");
  put_before(text, "],\n  \"accessors\"",
             buffer_view(204, 12) + buffer_view(216, 36) + buffer_view(252, 48) +
                 buffer_view(300, 108) + buffer_view(408, 12) + buffer_view(420, 36));
  text.insert(text.rfind("]\n}"), accessor(5, 3, "SCALAR") + accessor(6, 3, "VEC3") +
                                      accessor(7, 3, "VEC4") + accessor(8, 9, "VEC3") +
                                      accessor(9, 3, "SCALAR") + accessor(10, 3, "VEC3"));
  return text;
}

constexpr std::string_view translate =
    R"({"sampler": 0, "target": {"node": 0, "path": "translation"}})";
constexpr std::string_view turn = R"({"sampler": 0, "target": {"node": 0, "path": "rotation"}})";

class Animation : public Card {
 protected:
  Scene load(const std::string& text, const Shutter& shutter, const SceneLimits& limits = {}) {
    return Card::load(text, moving_data(), shutter, limits);
  }
  /// Where the card's first corner is while the shutter is closed.
  Vec3 corner(const std::string& text, double time) {
    const Scene scene = load(text, {time, time});
    EXPECT_EQ(scene.meshes.size(), 1u) << diagnostics_.to_string();
    if (scene.meshes.empty()) return {};
    EXPECT_TRUE(scene.meshes[0].instances.empty());
    return scene.meshes[0].position[1];  // (1, 0, 0)
  }
};

TEST_F(Animation, ClosedShuttersSeeTheMoment) {
  const std::string linear = moving_card(translate, R"({"input": 5, "output": 6})");
  expect_at(corner(linear, -3), {1, 0, 0});  // Before the first key, and behind the last.
  expect_at(corner(linear, 1.25), {3.5f, 0, 0});
  expect_at(corner(linear, 3), {11, 4, 0});
  expect_at(corner(linear, 99), {11, 8, 0});
  EXPECT_EQ(diagnostics_.to_string(), "");
  const std::string step =
      moving_card(translate, R"({"input": 5, "output": 6, "interpolation": "STEP"})");
  expect_at(corner(step, 1.999), {1, 0, 0});
  expect_at(corner(step, 2), {11, 0, 0});
  // glTF 2.0, C.5: halfway from 1 to 2, (a + b) / 2 + (out - in) / 8 with both tangents (3, 0, 0).
  const std::string cubic =
      moving_card(translate, R"({"input": 5, "output": 8, "interpolation": "CUBICSPLINE"})");
  expect_at(corner(cubic, 1.5), {6, 0, 0});
  // At a quarter: h10 = 9/64, h11 = -3/64, h01 = 10/64.
  expect_at(corner(cubic, 1.25), {1.f + 3.f * 9 / 64 - 3.f * 3 / 64 + 100.f / 64, 0, 0});
  // Halfway from 0 to 90 degrees.
  const std::string turning = moving_card(turn, R"({"input": 5, "output": 7})");
  expect_at(corner(turning, 1.5), {std::sqrt(0.5f), std::sqrt(0.5f), 0});
}

TEST_F(Animation, OpenShuttersSeeTheWay) {
  const Scene linear = load(moving_card(translate, R"({"input": 5, "output": 6})"), {1.5, 3});
  ASSERT_EQ(linear.meshes.size(), 1u) << diagnostics_.to_string();
  ASSERT_EQ(linear.meshes[0].instances.size(), 1u);
  const Motion& way = linear.meshes[0].instances[0];
  ASSERT_EQ(way.segments().size(), 2u);  // Round the corner at 2.
  EXPECT_EQ(way.steps(), 4u);
  expect_at(way.at(0.f).origin, {5, 0, 0});
  expect_at(way.at(1.f / 3).origin, {10, 0, 0});
  expect_at(way.at(1.f).origin, {10, 4, 0});
  expect_at(linear.meshes[0].position[1], {1, 0, 0});  // Its own space.

  const Scene step = load(
      moving_card(translate, R"({"input": 5, "output": 6, "interpolation": "STEP"})"), {1.5, 2.5});
  const Motion& jump = step.meshes.at(0).instances.at(0);
  expect_at(jump.at(0.499f).origin, {0, 0, 0});
  expect_at(jump.at(0.501f).origin, {10, 0, 0});

  const Scene turning = load(moving_card(turn, R"({"input": 5, "output": 7})"), {1, 4});
  const Motion& turned = turning.meshes.at(0).instances.at(0);
  for (float share = 0.f; share <= 1.f; share += 0.037f) {
    const float seconds = 1 + 3 * share, quarters = seconds < 2 ? seconds - 1 : seconds / 2;
    const float angle = quarters * std::numbers::pi_v<float> / 2;
    EXPECT_LT(length(turned.at(share).x - Vec3{std::cos(angle), std::sin(angle), 0}), 1e-3f);
  }
  // What does not move while the shutter is open is baked as if it never did.
  const Scene still = load(moving_card(translate, R"({"input": 5, "output": 6})"), {5, 6});
  EXPECT_TRUE(still.meshes.at(0).instances.empty());
}

// Embree divides by the length of a segment: found by a fuzzer, with keys at denormal times.
TEST_F(Animation, WhatLastsNoTimeIsNoSegment) {
  const std::string linear = moving_card(translate, R"({"input": 5, "output": 6})");
  for (const Shutter& shutter : {Shutter{2 - 1e-9, 3}, Shutter{1.5, 2 + 1e-9}}) {
    const Scene scene = load(linear, shutter);
    ASSERT_EQ(scene.meshes.size(), 1u) << diagnostics_.to_string();
    const Motion& way = scene.meshes[0].instances.at(0);
    ASSERT_EQ(way.segments().size(), 1u);
    EXPECT_EQ(way.segments()[0].begin, 0.f);
    EXPECT_EQ(way.segments()[0].end, 1.f);
    const Motion product = way * way;
    ASSERT_EQ(product.segments().size(), 1u);
    EXPECT_EQ(product.segments()[0].end, 1.f);
    EXPECT_TRUE(Bvh(scene, diagnostics_).ok());
  }
}

TEST_F(Animation, ChildrenAndCamerasGoAlong) {
  std::string text = moving_card(translate, R"({"input": 5, "output": 6})",
                                 R"("children": [2, 1], "scale": [2, 2, 2])");
  text.replace(text.find("[0, 1]"), 6, "[0]");
  text.insert(text.find("],\n  \"materials\""),
              R"(, {"name": "child", "mesh": 0, "translation": [0, 1, 0]})");
  const Scene scene = load(text, {1, 2});
  ASSERT_EQ(scene.meshes.size(), 2u) << diagnostics_.to_string();
  expect_at(scene.meshes[1].instances.at(0).at(0.5f).origin, {5, 2, 0});
  ASSERT_EQ(scene.cameras.size(), 1u);
  expect_at(scene.cameras[0].camera.position, {1, 1, 6});
  expect_at(transform_point(scene.cameras[0].motion.at(0.5f), scene.cameras[0].camera.position),
            {6, 1, 6});
}

TEST_F(Animation, WhatHidesByItsScaleDoesSo) {
  const std::string text = moving_card(R"({"sampler": 0, "target": {"node": 0, "path": "scale"}})",
                                       R"({"input": 5, "output": 6})");
  const Vec3 there = corner(text, 1);
  EXPECT_LT(length(there), 2e-6f);
  EXPECT_GT(length(there), 0.f);
}

struct Wrong {
  std::string_view channels, samplers, says;
};

TEST_F(Animation, WrongOnesAreRefusedByTheirPlace) {
  const Wrong cases[] = {
      {translate, R"({"input": 5})", "bad-gltf animations[0].samplers[0].output"},
      {translate, R"({"output": 6})", "bad-gltf animations[0].samplers[0].input"},
      {translate, R"({"input": 99, "output": 6})", "bad-gltf animations[0].samplers[0].input"},
      {translate, R"({"input": 6, "output": 6})", "bad-gltf animations[0].samplers[0].input"},
      {translate, R"({"input": 9, "output": 6})", "bad-gltf animations[0].samplers[0].input"},
      {translate, R"({"input": 5, "output": 7})", "bad-gltf animations[0].samplers[0].output"},
      {translate, R"({"input": 5, "output": 8})", "bad-gltf animations[0].samplers[0].output"},
      {translate, R"({"input": 5, "output": 10})", "bad-gltf animations[0].samplers[0].output"},
      {turn, R"({"input": 5, "output": 6})", "bad-gltf animations[0].samplers[0].output"},
      {translate, R"({"input": 5, "output": 6, "interpolation": "CUBICSPLINE"})",
       "bad-gltf animations[0].samplers[0].output"},
      {translate, R"({"input": 5, "output": 6, "interpolation": "BEZIER"})",
       "bad-gltf animations[0].samplers[0].interpolation"},
      {translate, R"({"input": 5, "output": 6, "interpolation": 1})",
       "bad-gltf animations[0].samplers[0].interpolation"},
      {translate, "", "bad-gltf animations[0].channels[0].sampler"},
      {R"({"sampler": 0, "target": {"node": 7, "path": "scale"}})", R"({"input": 5, "output": 6})",
       "bad-gltf animations[0].channels[0].target.node"},
      {R"({"sampler": 0, "target": {"node": 0, "path": "colour"}})", R"({"input": 5, "output": 6})",
       "bad-gltf animations[0].channels[0].target.path"},
      {R"({"sampler": 0, "target": {"node": 0}})", R"({"input": 5, "output": 6})",
       "bad-gltf animations[0].channels[0].target.path"},
      {R"({"sampler": 0})", R"({"input": 5, "output": 6})",
       "bad-gltf animations[0].channels[0].target.path"},
      {R"(3)", R"({"input": 5, "output": 6})", "bad-gltf animations[0].channels[0]"},
  };
  for (const Wrong& wrong : cases) {
    const Scene scene = load(moving_card(wrong.channels, wrong.samplers), {0, 3});
    EXPECT_TRUE(scene.meshes.empty()) << wrong.samplers;
    EXPECT_EQ(first(), wrong.says) << diagnostics_.to_string();
  }
  const std::string twice = std::string(translate) + ", " + std::string(translate);
  load(moving_card(twice, R"({"input": 5, "output": 6})"), {});
  EXPECT_EQ(first(), "bad-gltf animations[0].channels[1].target");
  load(moving_card(translate, R"({"input": 5, "output": 6})",
                   R"("matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1])"),
       {});
  EXPECT_EQ(first(), "bad-gltf animations[0].channels[0].target");
}

TEST_F(Animation, WhatIsLeftOutIsSaid) {
  load(moving_card(R"({"sampler": 0, "target": {"node": 0, "path": "weights"}})",
                   R"({"input": 5, "output": 6})"),
       {});
  EXPECT_EQ(first(), "bad-gltf animations[0].channels[0].target");  // No targets to weigh.
  load(moving_card(R"({"sampler": 0, "target": {"path": "pointer"}})",
                   R"({"input": 5, "output": 6})"),
       {});
  EXPECT_EQ(first(), "animation-not-rendered animations[0].channels[0].target");
  std::string two = moving_card(translate, R"({"input": 5, "output": 6})");
  two.replace(two.find("\"animations\": ["), 15, "\"animations\": [{\"channels\": []}, ");
  expect_at(corner(two, 3), {1, 0, 0});  // The first has none.
  EXPECT_EQ(first(), "several-animations animations");
}

TEST_F(Animation, CountsAgainstTheBudget) {
  const std::string text = moving_card(translate, R"({"input": 5, "output": 6})");
  const Scene scene = load(text, {1, 4}, {.bytes = 40'000});
  EXPECT_FALSE(scene.meshes.empty()) << diagnostics_.to_string();
  load(text, {1, 4}, {.bytes = 10'000});
  EXPECT_EQ(first().substr(0, 15), "scene-too-large");
}

std::string instanced(std::string_view attributes) {
  return moving_card("", "",
                     R"("extensions": {"EXT_mesh_gpu_instancing": {"attributes": )" +
                         std::string(attributes) + R"(}}, "scale": [2, 2, 2])");
}

TEST_F(Animation, InstancesStandWhereTheirListsSay) {
  const Scene scene = load(instanced(R"({"TRANSLATION": 6, "ROTATION": 7, "_ID": 5})"), {});
  ASSERT_EQ(scene.meshes.size(), 1u) << diagnostics_.to_string();
  EXPECT_EQ(first(),
            "instance-attributes-not-rendered "
            "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes._ID");
  const auto& places = scene.meshes[0].instances;
  ASSERT_EQ(places.size(), 3u);
  expect_at(places[1].still().origin, {20, 0, 0});  // The node's scale is above them.
  expect_at(places[1].still().x, {0, 2, 0});
  expect_at(places[2].still().origin, {20, 16, 0});
  EXPECT_EQ(bounds(scene).high.y, 16.f);
  const SceneLimits three{.meshes = 3}, two{.meshes = 2};
  EXPECT_FALSE(load(instanced(R"({"TRANSLATION": 6})"), {}, three).meshes.empty());
  load(instanced(R"({"TRANSLATION": 6})"), {}, two);
  EXPECT_EQ(first(), "scene-too-large meshes[0].primitives[0]");
}

TEST_F(Animation, WrongInstancesAreRefused) {
  const std::string at = "bad-gltf nodes[0].extensions.EXT_mesh_gpu_instancing.attributes";
  const std::pair<std::string_view, std::string> cases[] = {
      {"{}", at},
      {"3", at},
      {R"({"TRANSLATION": 77})", at + ".TRANSLATION"},
      {R"({"TRANSLATION": 7})", at + ".TRANSLATION"},
      {R"({"TRANSLATION": 10})", at + ".TRANSLATION"},
      {R"({"ROTATION": 6})", at + ".ROTATION"},
      {R"({"TRANSLATION": 6, "SCALE": 8})", at + ".SCALE"},
      {R"({"SCALE": 6})", "bad-gltf nodes[0]"},  // A scale of 0.
  };
  for (const auto& [attributes, says] : cases) {
    EXPECT_TRUE(load(instanced(attributes), {}).meshes.empty()) << attributes;
    EXPECT_EQ(first(), says) << diagnostics_.to_string();
  }
}

}  // namespace
}  // namespace nacre::host
