// Skins, morph targets and sparse accessors of glTF files, beside positions worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "examples/render/bvh.h"
#include "examples/render/surface.h"
#include "tests/examples/render/card_fixture.h"

namespace nacre::host {
namespace {

/// Behind the card's data: 204-219 joints of the four corners, 0 0 1 1 first; 220-283 weights, of
/// which the third and fourth corner share both joints; 284-411 two inverse bind matrices, the
/// second of which takes y = 1 to 0; 412-423 an offset; 424-425 the index 2; 428-439 times 0 1 2;
/// 440-451 weights 0 1 0; 452-499 offsets of all corners along z.
std::string bending_data() {
  std::string data = card_data();
  append<std::uint8_t>(data, {0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  append<float>(data, {1, 0, 0, 0, 1, 0, 0, 0, 0.75f, 0.25f, 0, 0, 1, 0, 0, 0});
  append<float>(data, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  append<float>(data, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
  append<float>(data, {0, 0, 4});
  append<std::uint16_t>(data, {2, 0});
  append<float>(data, {0, 1, 2});
  append<float>(data, {0, 1, 0});
  append<float>(data, {0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4});
  return data;
}

/// The card with accessors from 5: joints, weights, matrices, a sparse list of offsets (the third
/// corner's is 4 along z), times, weights of one target, offsets along z.
std::string bending_card(std::string_view primitive, std::string_view node,
                         std::string_view root = "") {
  std::string text = spoiled_card("\"byteLength\": 204", "\"byteLength\": 500");
  text.replace(text.find("\"scale\": [1, 1, 1]"), 18, node);
  put_before(text, "\"indices\": 2", std::string(primitive));
  text.replace(text.find("\"nodes\": [0, 1]"), 15, "\"nodes\": [0, 1, 2]");
  const std::size_t camera = text.find("{\"camera\": 0");
  const std::size_t end = text.find('}', camera) + 1;
  text.insert(end, R"(, {"children": [3]}, {"translation": [0, 1, 0], "rotation": [0, 0,
      0.70710678, 0.70710678]})");
  put_before(text, "\"scenes\"", std::string(root));
  put_before(text, "],\n  \"accessors\"",
             buffer_view(204, 16) + buffer_view(220, 64) + buffer_view(284, 128) +
                 buffer_view(412, 12) + buffer_view(424, 2) + buffer_view(428, 12) +
                 buffer_view(440, 12) + buffer_view(452, 48));
  const std::string sparse = R"(, {"componentType": 5126, "count": 4, "type": "VEC3", "sparse":
      {"count": 1, "indices": {"bufferView": 9, "componentType": 5123}, "values": {"bufferView": 8}}})";
  text.insert(text.rfind("]\n}"), accessor(5, 4, "VEC4", 5121) + accessor(6, 4, "VEC4") +
                                      accessor(7, 2, "MAT4") + sparse + accessor(10, 3, "SCALAR") +
                                      accessor(11, 3, "SCALAR") + accessor(12, 4, "VEC3"));
  const std::size_t attributes = text.find("\"NORMAL\": 3");
  if (primitive.empty()) text.insert(attributes, R"("JOINTS_0": 5, "WEIGHTS_0": 6, )");
  return text;
}

constexpr std::string_view skin = R"("skins": [{"joints": [2, 3], "inverseBindMatrices": 7}], )";
constexpr std::string_view morph = R"("targets": [{"POSITION": 8}, {"POSITION": 11}], )";

class Deform : public Card {
 protected:
  Scene load(const std::string& text, const Shutter& shutter = {}) {
    return Card::load(text, bending_data(), shutter);
  }
  /// The four corners, in their order.
  std::vector<Vec3> corners(const std::string& text, double time = 0) {
    const Scene scene = load(text, {time, time});
    EXPECT_EQ(scene.meshes.size(), 1u) << diagnostics_.to_string();
    return scene.meshes.empty() ? std::vector<Vec3>(4) : scene.meshes[0].position;
  }
};

// The second joint stands at (0, 1, 0), turned by 90 degrees about z, and its inverse bind matrix
// takes (x, y) to (x, y - 1): (1, 1) goes to (0, 2) and (0, 1) stays. The node's own place, ten
// along x, does not count.
TEST_F(Deform, SkinsMixWhereJointsTakeVertices) {
  const auto at = corners(bending_card("", R"("translation": [10, 0, 0], "skin": 0)", skin));
  expect_at(at[0], {0, 0, 0});
  expect_at(at[1], {1, 0, 0});
  // 0.75 of the second joint's (0, 2) and 0.25 of the first's (1, 1).
  expect_at(at[2], {0.25f, 1.75f, 0});
  expect_at(at[3], {0, 1, 0});
  EXPECT_EQ(diagnostics_.to_string(), "");
}

TEST_F(Deform, MorphTargetsAddTheirShares) {
  const auto at = corners(bending_card(morph, R"("weights": [0.5, 0.25])"));
  expect_at(at[0], {0, 0, 0.25f});
  expect_at(at[1], {1, 0, 0.5f});
  expect_at(at[2], {1, 1, 0.75f + 2});  // And half of the sparse list's 4.
  expect_at(at[3], {0, 1, 1});
}

TEST_F(Deform, WeightsAreAnimated) {
  const std::string root = R"("animations": [{"channels": [{"sampler": 0, "target": {"node": 0,
      "path": "weights"}}], "samplers": [{"input": 9, "output": 10}]}], )";
  const std::string one = R"("targets": [{"POSITION": 11}], )";
  const std::string text = bending_card(one, R"("scale": [1, 1, 1])", root);
  expect_at(corners(text, 0)[3], {0, 1, 0});
  expect_at(corners(text, 0.5)[3], {0, 1, 2});
  expect_at(corners(text, 1)[3], {0, 1, 4});
  expect_at(corners(text, 1.75)[3], {0, 1, 1});
  // While the shutter is open it bends: rays meet it where its vertices are at their time.
  const Scene scene = load(text, {0, 1});
  ASSERT_EQ(scene.meshes.size(), 1u) << diagnostics_.to_string();
  ASSERT_FALSE(scene.meshes[0].poses.empty());
  const Bvh bvh(scene, diagnostics_);
  for (const float time : {0.f, 0.3f, 1.f}) {
    const Ray ray{.origin = {0.75f, 0.25f, 10.f}, .direction = {0, 0, -1}, .time = time};
    Hit hit;
    bvh.intersect({&ray, 1}, {&hit, 1}, true);
    ASSERT_FALSE(hit.missed());
    // (0,0,t) (1,0,2t) (1,1,3t): z = t + x t + y t.
    EXPECT_NEAR(10.f - hit.distance, time * (1.f + 0.75f + 0.25f), 1e-4f);
    const SurfacePoint p{
        .mesh = hit.mesh, .triangle = hit.triangle, .u = hit.u, .v = hit.v, .time = time};
    EXPECT_NEAR(surface_position(scene, p).z, 2 * time, 1e-4f);
    // The plane's normal is (-t, -t, 1), normalised.
    const Vec3 n = surface_normal(scene, p);
    EXPECT_NEAR(std::abs(n.z), 1.f / std::sqrt(1.f + 2 * time * time), 1e-4f);
  }
}

TEST_F(Deform, WrongOnesAreRefused) {
  const std::string node = R"("skin": 0)";
  const auto says = [&](const std::string& text) {
    const Scene scene = load(text);
    EXPECT_TRUE(scene.meshes.empty());
    return first();
  };
  EXPECT_EQ(says(bending_card("", node, R"("skins": [{"joints": [2]}], )")),
            "bad-gltf meshes[0].primitives[0].attributes.JOINTS_0");
  // Of signed numbers there are no joints: glTF 2.0, 3.7.3.3.
  std::string is_signed = bending_card("", node, skin);
  const std::string_view joints = R"("bufferView": 5, "componentType": 5121)";
  ASSERT_NE(is_signed.find(joints), std::string::npos);
  is_signed.replace(is_signed.find(joints), joints.size(),
                    R"("bufferView": 5, "componentType": 5120)");
  EXPECT_EQ(says(is_signed), "bad-gltf meshes[0].primitives[0].attributes.JOINTS_0");
  EXPECT_EQ(says(bending_card("", node, R"("skins": [{"joints": [2, 9]}], )")),
            "bad-gltf skins[0].joints[1]");
  EXPECT_EQ(says(bending_card("", node, R"("skins": [{"joints": [2, 3, 2],
            "inverseBindMatrices": 7}], )")),
            "bad-gltf skins[0].inverseBindMatrices");
  EXPECT_EQ(says(bending_card(R"("extras": 0, )", node, skin)),
            "bad-gltf meshes[0].primitives[0].attributes");
  EXPECT_EQ(says(bending_card(R"("targets": [{"POSITION": 1}], )", "\"weights\": [1]")),
            "bad-gltf meshes[0].primitives[0].targets[0].POSITION");
  std::string sparse = bending_card(morph, "\"weights\": [1, 0]");
  sparse.replace(sparse.find("\"bufferView\": 9, \"componentType\": 5123"), 38,
                 "\"bufferView\": 0, \"byteOffset\": 14, \"componentType\": 5123");
  EXPECT_EQ(says(sparse), "bad-gltf accessors[8].sparse.indices");
}

}  // namespace
}  // namespace nacre::host
