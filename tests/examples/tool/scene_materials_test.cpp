// Renders of glTF scenes with materials of their own, through the tool.
#include <OpenImageIO/imageio.h>

#include <cmath>

#include "tests/examples/render/scene_samples.h"
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

/// Red and green above blue and white.
constexpr std::string_view four_texels =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAEklEQVR4nGP4z8DAAMIM/4EAA"
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
             "images": [{"uri": ")" + file_of_image + R"("}], )");
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
      EXPECT_NEAR(seen[static_cast<std::size_t>(32 * y + x) * 3 + c], color[c], 1e-5f) << x << ' ' << y;
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
           [1, 0, 0, 1]}, "doubleSided": )" + std::string(both ? "true}" : "false}"));
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

TEST_F(SceneMaterials, SayWhatGltfPbrLacks) {
  scene(R"({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
            "KHR_materials_dispersion": {"dispersion": 1}}})");
  EXPECT_EQ(run("render -q --scene " + file("a.gltf") + " --write-document " + file("a.mtlx")), 0);
  EXPECT_TRUE(says("not-in-gltf-pbr")) << errors_;
  EXPECT_TRUE(says("a thin wall")) << errors_;
  EXPECT_TRUE(says("dispersion")) << errors_;
}

}  // namespace
}  // namespace nacre
