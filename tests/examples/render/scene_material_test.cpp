// Materials of glTF files as they are read.
#include <gtest/gtest.h>

#include "tests/examples/render/card_fixture.h"

namespace nacre::host {
namespace {

constexpr std::string_view paint = R"([{"name": "paint"}])";

class SceneMaterials : public Card {
 protected:
  Scene load(std::string_view materials, std::string_view root = "",
             const std::string& variant = "") {
    std::string text = spoiled_card(paint, materials);
    text.insert(text.find("\"scenes\""), root);
    return Card::load(text, card_data(), {}, {}, {true, variant});
  }
};

TEST_F(SceneMaterials, HaveTheSpecificationsDefaults) {
  const Scene scene = load(paint);
  ASSERT_EQ(scene.materials.all.size(), 1u) << diagnostics_.to_string();
  const SceneMaterial& m = scene.materials.all[0];
  EXPECT_EQ(scene.meshes.at(0).material, 0u);
  EXPECT_EQ(m.base_color.value, (std::array<float, 4>{1, 1, 1, 1}));
  EXPECT_EQ(m.metallic, 1.f);
  EXPECT_EQ(m.roughness, 1.f);
  EXPECT_FALSE(m.two_sided);
  EXPECT_EQ(m.alpha, SceneMaterial::Alpha::opaque);
  EXPECT_EQ(m.ior, 1.5f);
  EXPECT_EQ(diagnostics_.to_string(), "");
}

TEST_F(SceneMaterials, HaveTexturesWithTheirSamplersAndTransforms) {
  const Scene scene = load(
      R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 1, "extensions":
          {"KHR_texture_transform": {"offset": [0.5, 0.25], "rotation": 0.1, "scale": [2, 3]}}}}}])",
      R"("textures": [{"source": 0, "sampler": 0}], "images": [{"uri": "two%20words.png"}],
         "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}], )");
  ASSERT_EQ(scene.materials.images.size(), 1u) << diagnostics_.to_string();
  EXPECT_EQ(scene.materials.images[0].file, "two words.png");
  const auto& texture = scene.materials.all[0].base_color.texture;
  ASSERT_TRUE(texture.has_value());
  EXPECT_EQ(texture->set, 1u);
  EXPECT_EQ(texture->offset.y, 0.25f);
  EXPECT_EQ(texture->scale.x, 2.f);
  EXPECT_EQ(texture->rotation, 0.1f);
  EXPECT_EQ(texture->wrap_u, SceneTexture::Wrap::clamp);
  EXPECT_EQ(texture->wrap_v, SceneTexture::Wrap::mirror);
  EXPECT_TRUE(texture->is_closest);
}

TEST_F(SceneMaterials, HoldImagesThatTheFileHolds) {
  // The eight bytes that a PNG begins with.
  const Scene scene = load(R"([{"emissiveTexture": {"index": 0}}])",
                           R"("textures": [{"source": 0}], "images": [
                               {"uri": "data:image/png;base64,iVBORw0KGgo="}], )");
  ASSERT_EQ(scene.materials.images.size(), 1u) << diagnostics_.to_string();
  EXPECT_EQ(scene.materials.images[0].extension, ".png");
  EXPECT_EQ(*scene.materials.images[0].bytes, "\x89PNG\r\n\x1a\n");
}

TEST_F(SceneMaterials, OfAVariant) {
  const std::string_view two = R"([{"name": "red"}, {"name": "blue"}])";
  const std::string_view root =
      R"("extensions": {"KHR_materials_variants": {"variants": [{"name": "day"}, {"name": "night"}]}},
      )";
  EXPECT_EQ(load(two, root).meshes.at(0).material_name, "red");
  EXPECT_TRUE(load(two, root, "noon").meshes.empty());
  EXPECT_EQ(first(), "unknown-variant extensions.KHR_materials_variants.variants");
  std::string text = spoiled_card(paint, two);
  text.insert(text.find("\"scenes\""), root);
  const std::string_view own = "\"material\": 0";
  text.replace(text.find(own), own.size(), R"("material": 0, "extensions": {
      "KHR_materials_variants": {"mappings": [{"variants": [1], "material": 1}]}})");
  diagnostics_ = {};
  const std::string path = folder_.write("b.gltf", text);
  EXPECT_EQ(load_scene(path, {}, diagnostics_, {}, {false, "night"}).meshes.at(0).material_name,
            "blue");
  EXPECT_EQ(load_scene(path, {}, diagnostics_, {}, {false, "day"}).meshes.at(0).material_name,
            "red");
}

TEST_F(SceneMaterials, WrongOnesAreRefused) {
  const auto says = [&](std::string_view materials, std::string_view root = "") {
    EXPECT_TRUE(load(materials, root).meshes.empty());
    return first();
  };
  EXPECT_EQ(says(R"([{"alphaMode": "GLASS"}])"), "bad-gltf materials[0].alphaMode");
  EXPECT_EQ(says(R"([{"pbrMetallicRoughness": {"metallicFactor": 2}}])"),
            "bad-gltf materials[0].pbrMetallicRoughness.metallicFactor");
  EXPECT_EQ(says(R"([{"emissiveFactor": [1, 2]}])"), "bad-gltf materials[0].emissiveFactor");
  EXPECT_EQ(says(R"([{"normalTexture": {"index": 3}}])"),
            "bad-gltf materials[0].normalTexture.index");
  EXPECT_EQ(says(paint, R"("extensionsRequired": ["KHR_materials_hologram"], )"),
            "bad-gltf extensionsRequired[0]");
  load(R"([{"extensions": {"EXT_own": {}}}])");
  EXPECT_EQ(first(), "extension-not-rendered materials[0].extensions.EXT_own");
}

// A texture in a form that no reader has is left out, and said.
TEST_F(SceneMaterials, UnreadableTexturesAreSaid) {
  const Scene scene = load(R"([{"normalTexture": {"index": 0}}])",
                           R"("textures": [{"extensions": {"KHR_texture_basisu": {"source": 0}}}],
                              "images": [{"uri": "a.ktx2"}], )");
  ASSERT_EQ(scene.materials.all.size(), 1u) << diagnostics_.to_string();
  EXPECT_FALSE(scene.materials.all[0].normal.texture.has_value());
  EXPECT_EQ(first(), "texture-not-rendered textures[0]");
}

}  // namespace
}  // namespace nacre::host
