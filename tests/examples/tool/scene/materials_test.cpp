// Renders of glTF scenes with materials of their own, through the tool.
#include <OpenImageIO/imageio.h>

#include <cmath>

#include "tests/examples/render/scene_samples.h"
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

/// Red and green above blue and white.
constexpr std::string_view four_texels =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR4nGP4z8DAAMIM/"
    "4EAA"
    "B/uBfsL2WiLAAAAAElFTkSuQmCC";

class SceneMaterials : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    write("card.bin", host::card_data());
  }

  /// The card with a material in place of its own.
  void scene(const std::string& material, const std::string& root = "") {
    std::string text = host::spoiled_card(R"({"name": "paint"})", material);
    text.insert(text.find("\"scenes\""), root);
    write("a.gltf", text);
  }
  int render(const std::string& arguments) {
    return run("render " + arguments + " -q --size 32 --spp 4 --no-cache --environment-scale 1");
  }
  /// RGB, 32 by 32.
  std::vector<float> pixels(const std::string& name) {
    std::vector<float> all(32 * 32 * 3);
    const auto image = OIIO::ImageInput::open(file(name));
    EXPECT_NE(image, nullptr) << name << ' ' << errors_;
    if (image != nullptr) image->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, all.data());
    return all;
  }
};

TEST_F(SceneMaterials, AreThoseOfGltfPbr) {
  scene(R"({"name": "red paint", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.125, 0.25, 1],
            "metallicFactor": 0.25, "roughnessFactor": 0.5}, "emissiveFactor": [0, 0.125, 0],
            "extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 0.5},
                           "KHR_materials_ior": {"ior": 1.25}}})");
  write("hand.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709">
    <gltf_pbr name="S" type="surfaceshader">
      <input name="base_color" type="color3" value="0.5, 0.125, 0.25"/>
      <input name="metallic" type="float" value="0.25"/>
      <input name="roughness" type="float" value="0.5"/>
      <input name="emissive" type="color3" value="0, 0.125, 0"/>
      <input name="clearcoat" type="float" value="0.5"/>
      <input name="ior" type="float" value="1.25"/>
    </gltf_pbr>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/>
    </surfacematerial></materialx>)");
  ASSERT_EQ(render("--scene " + file("a.gltf") + " --out " + file("own.exr")), 0) << errors_;
  ASSERT_EQ(render(file("hand.mtlx") + " --scene " + file("a.gltf") + " --out " + file("hand.exr")),
            0)
      << errors_;
  EXPECT_EQ(pixels("own.exr"), pixels("hand.exr"));
  // The document that is written makes the same picture.
  ASSERT_EQ(run("render --scene " + file("a.gltf") + " -q --write-document " + file("own.mtlx")), 0)
      << errors_;
  EXPECT_NE(text_of(file("own.mtlx")).find("red_paint"), std::string::npos);
  ASSERT_EQ(render(file("own.mtlx") + " --scene " + file("a.gltf") + " --out " + file("again.exr")),
            0)
      << errors_;
  EXPECT_EQ(pixels("own.exr"), pixels("again.exr"));
}

// KHR_texture_transform: uv' = T R S uv; a turn by 90 degrees about the upper left corner takes
// (u, v) to (v, -u), and the offset to (v, 1 - u): the picture is turned clockwise.
TEST_F(SceneMaterials, LayTexturesAsTheirTransformsSay) {
  const auto turned = [&](const std::string& file_of_image) {
    scene(R"({"doubleSided": true, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
              "extensions": {"KHR_texture_transform": {"rotation": 1.57079633, "offset": [0, 1]}}}},
              "extensions": {"KHR_materials_unlit": {}}})",
          R"("textures": [{"source": 0, "sampler": 0}], "samplers": [{"magFilter": 9728}],
             "images": [{"uri": ")" +
              file_of_image + R"("}], )");
  };
  turned(std::string(four_texels));
  ASSERT_EQ(render("--scene " + file("a.gltf") + " --out " + file("a.exr") + " --write-document " +
                   file("own.mtlx")),
            0)
      << errors_;
  const std::vector<float> seen = pixels("a.exr");
  // The card is from pixel 5.6 to 26.4.
  const auto expect = [&](int x, int y, std::array<float, 3> color) {
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(seen[static_cast<std::size_t>(32 * y + x) * 3 + c], color[c], 1e-5f)
          << x << ' ' << y;
    }
  };
  expect(10, 10, {0, 0, 1});
  expect(21, 10, {1, 0, 0});
  expect(10, 21, {1, 1, 1});
  expect(21, 21, {0, 1, 0});
  // The image was put beside the document; and a file that the scene names is the same.
  ASSERT_TRUE(names_in(folder_.path().string()).contains("own_image0.png"));
  turned("own_image0.png");
  ASSERT_EQ(render("--scene " + file("a.gltf") + " --out " + file("b.exr")), 0) << errors_;
  EXPECT_EQ(seen, pixels("b.exr"));
  turned("nowhere.png");
  EXPECT_EQ(render("--scene " + file("a.gltf") + " --out " + file("c.exr")), 1);
  EXPECT_TRUE(says("nowhere.png")) << errors_;
}

// A card that is seen from behind is there only if its material says so.
TEST_F(SceneMaterials, HaveSides) {
  for (const bool both : {false, true}) {
    std::string text = host::spoiled_card(
        R"({"name": "paint"})",
        R"({"extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {"baseColorFactor":
           [1, 0, 0, 1]}, "doubleSided": )" +
            std::string(both ? "true}" : "false}"));
    const std::string_view from = R"("translation": [0.5, 0.5, 3])";
    text.replace(text.find(from), from.size(),
                 R"("translation": [0.5, 0.5, -3], "rotation": [0, 1, 0, 0])");
    write("a.gltf", text);
    ASSERT_EQ(render("--scene " + file("a.gltf") + " --out " + file("a.exr")), 0) << errors_;
    const std::vector<float> seen = pixels("a.exr");
    const float* middle = &seen[(32 * 16 + 16) * 3];
    EXPECT_EQ(middle[0] == 1.f && middle[1] == 0.f && middle[2] == 0.f, both);  // Else the studio.
  }
}

TEST_F(SceneMaterials, AreAskedForWithAScene) {
  scene("{}");
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write("a.mtlx", "<materialx version=\"1.39\"/>");
  EXPECT_EQ(render("--out " + file("a.png")), 2);
  EXPECT_EQ(render("--scene " + file("a.obj") + " --out " + file("a.png")), 2);
  EXPECT_TRUE(says("FILE.mtlx")) << errors_;
  EXPECT_EQ(render("--scene " + file("a.gltf")), 2);
  EXPECT_EQ(render(file("a.mtlx") + " --scene " + file("a.gltf") + " --out " + file("a.png") +
                   " --write-document " + file("b.mtlx")),
            2);
  EXPECT_EQ(render("--scene " + file("a.gltf") + " --variant night --out " + file("a.png")), 1);
  EXPECT_TRUE(says("unknown-variant")) << errors_;
}

/// Of side 1 about the origin, of a material, or without one where that is "".
class SceneCube : public SceneMaterials {
 protected:
  /// The pixel in the middle, of three channels.
  std::array<double, 3> middle_of(const std::string& material) {
    std::string data;
    for (int i = 0; i < 8; ++i) {
      host::append<float>(data, {i & 1 ? 0.5f : -0.5f, i & 2 ? 0.5f : -0.5f, i & 4 ? 0.5f : -0.5f});
    }
    host::append<std::uint16_t>(data, {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5});
    write("a.glb", host::glb(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
      "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 4]}],
      "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
      "materials": [)" + material +
                                 R"(], "buffers": [{"byteLength": 168}],
      "bufferViews": [{"buffer": 0, "byteLength": 96},
                      {"buffer": 0, "byteOffset": 96, "byteLength": 72}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
                    {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}]})",
                             data));
    EXPECT_EQ(render("--scene " + file("a.glb") + " --out " + file("a.exr")), 0) << errors_;
    const std::vector<float> seen = pixels("a.exr");
    const float* middle = &seen[(32 * 16 + 16) * 3];
    return {middle[0], middle[1], middle[2]};
  }

  std::array<double, 3> behind_ = middle_of(R"({"alphaMode": "MASK", "alphaCutoff": 2})");
};

// KHR_materials_volume: over a length d, c^(d / attenuationDistance) of light is left; where the
// index is 1 nothing is bent or reflected. The middle pixel is 1/64 of the view beside the axis.
TEST_F(SceneCube, OfAVolumeAttenuatesByItsLength) {
  const auto seen =
      middle_of(R"({"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0},
    "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
      "KHR_materials_ior": {"ior": 1}, "KHR_materials_specular": {"specularFactor": 0},
      "KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 0.5,
                               "attenuationColor": [0.25, 0.5, 1]}}})");
  EXPECT_NEAR(seen[0] / behind_[0], 0.0625, 1e-4);
  EXPECT_NEAR(seen[1] / behind_[1], 0.25, 2e-4);
  EXPECT_NEAR(seen[2] / behind_[2], 1.0, 1e-4);
}

// KHR_materials_transmission: without a volume, or with one of no thickness, each surface is a thin
// wall. Light goes through two of them on its way, straight, whatever their index.
TEST_F(SceneCube, WithoutThicknessIsOfThinWalls) {
  for (const char* volume : {"", R"(, "KHR_materials_volume": {"attenuationDistance": 0.5,
                                      "attenuationColor": [0, 0, 0]})"}) {
    const auto seen = middle_of(R"({"pbrMetallicRoughness": {"metallicFactor": 0,
      "roughnessFactor": 0, "baseColorFactor": [0.25, 0.5, 1, 1]}, "extensions": {
        "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 2},
        "KHR_materials_specular": {"specularFactor": 0})" +
                                std::string(volume) + "}}");
    EXPECT_NEAR(seen[0] / behind_[0], 0.0625, 1e-5);
    EXPECT_NEAR(seen[1] / behind_[1], 0.25, 1e-5);
    EXPECT_NEAR(seen[2] / behind_[2], 1.0, 1e-5);
  }
}

// What is written for others has the nodes that the library has not.
TEST_F(SceneCube, IsWrittenWithItsNodes) {
  const auto seen = middle_of(R"({"name": "glass", "pbrMetallicRoughness": {"metallicFactor": 0},
    "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.5}}})");
  ASSERT_EQ(render("--scene " + file("a.glb") + " --write-document " + file("own.mtlx")), 0)
      << errors_;
  ASSERT_EQ(render(file("own.mtlx") + " --scene " + file("a.glb") + " --out " + file("b.exr")), 0)
      << errors_;
  const std::vector<float> again = pixels("b.exr");
  EXPECT_EQ(double{again[(32 * 16 + 16) * 3]}, seen[0]);
}

TEST_F(SceneMaterials, SayWhatGltfPbrLacks) {
  scene(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_volume": {"thicknessFactor": 1},
            "KHR_materials_dispersion": {"dispersion": 1}}})");
  EXPECT_EQ(run("render -q --scene " + file("a.gltf") + " --write-document " + file("a.mtlx")), 0);
  EXPECT_TRUE(says("not-in-gltf-pbr")) << errors_;
  EXPECT_TRUE(says("dispersion")) << errors_;
}

// A texture that only WebP or KTX2 has is left out with a warning, unless the file cannot do
// without.
TEST_F(SceneMaterials, NameTexturesThatAreNotRead) {
  const std::string material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";
  const std::string texture =
      R"("textures": [{"extensions": {"KHR_texture_basisu": {"source": 0}}}],
                                 "images": [{"uri": "a.ktx2"}], )";
  scene(material, texture);
  EXPECT_EQ(render("--scene " + file("a.gltf") + " --out " + file("a.exr")), 0) << errors_;
  EXPECT_TRUE(says("texture-not-rendered")) << errors_;
  EXPECT_TRUE(says("KHR_texture_basisu")) << errors_;
  scene(material, texture + R"("extensionsRequired": ["KHR_texture_basisu"], )");
  EXPECT_EQ(render("--scene " + file("a.gltf") + " --out " + file("a.exr")), 1);
  EXPECT_TRUE(says("KHR_texture_basisu")) << errors_;
}

// Passes name a scene's own materials; and what a checkpoint was begun with is not only where it
// is.
TEST_F(SceneMaterials, AreThoseOfPassesAndCheckpoints) {
  const auto draw = [&](const char* color, const std::string& more) {
    scene(R"({"name": "red paint", "pbrMetallicRoughness": {"baseColorFactor": )" +
          std::string(color) + "}}");
    return render("--scene " + file("a.gltf") + " --out " + file("a.exr") + more);
  };
  ASSERT_EQ(draw("[1, 0, 0, 1]", " --aov mesh_id,crypto_material"), 0) << errors_;
  EXPECT_NE(text_of(file("a.exr")).find("red_paint"), std::string::npos);
  const std::string goes_on = " --checkpoint " + file("a.checkpoint");
  ASSERT_EQ(draw("[1, 0, 0, 1]", goes_on + " --time-limit 0.000001"), 0) << errors_;
  EXPECT_NE(draw("[0, 1, 0, 1]", goes_on), 0);
  EXPECT_TRUE(says("bad-checkpoint")) << errors_;
}

}  // namespace
}  // namespace nacre
