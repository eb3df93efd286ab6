// Baking on the meshes of a scene: what is written, refused and said.
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/examples/render/scene_samples.h"
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

struct Texels {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;

  const float* at(int x, int y) const {
    return values.data() + static_cast<std::ptrdiff_t>((y * width + x) * channels);
  }
};

Texels read_texels(const std::string& path) {
  const auto in = OIIO::ImageInput::open(path);
  if (!in) return {};
  Texels texels{in->spec().width, in->spec().height, in->spec().nchannels, {}};
  texels.values.resize(in->spec().image_pixels() * static_cast<std::size_t>(texels.channels));
  in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, texels.values.data());
  return texels;
}

/// A floor from (0, -1000) to (4, 1000) of (x, z), u along x, and a wall of height 1 at x = 0 that
/// has the rest of uv.
constexpr std::string_view floor_and_wall = R"(
v 0 0 1000
v 4 0 1000
v 4 0 -1000
v 0 0 -1000
v 0 1 1000
v 0 1 -1000
vt 0 0
vt 1 0
vt 1 0.5
vt 0 0.5
vt 0 0.6
vt 1 0.6
vt 1 1
vt 0 1
o floor
f 1/1 2/2 3/3 4/4
o wall
f 1/5 4/6 6/7 5/8
)";

std::string property(const std::string& name, const std::string& type = "float") {
  return "<geompropvalue name=\"n\" type=\"" + type +
         "\"><input name=\"geomprop\" type=\"string\" value=\"" + name + "\"/></geompropvalue>";
}

class BakeMesh : public Tool {
 protected:
  /// One output of a graph of these nodes.
  int bake(const std::string& nodes, const std::string& type, const std::string& options) {
    write("a.mtlx", "<materialx version=\"1.39\"><nodegraph name=\"G\">\n" + nodes +
                        "<output name=\"o\" type=\"" + type +
                        "\" nodename=\"n\"/></nodegraph></materialx>");
    return run("bake " + file("a.mtlx") + " --no-cache --out " + file("out") + " " + options);
  }
  std::string scene(std::string_view text = floor_and_wall) {
    return "--scene " + write("a.obj", text) + " ";
  }
};

/// The form factor of the wall, (1 - x / sqrt(x^2 + 1)) / 2, is what the floor lacks.
TEST_F(BakeMesh, AmbientOcclusionBesideAWall) {
  ASSERT_EQ(bake(property("ambientocclusion"), "float",
                 scene() + "--mesh floor --size 8x2 --rays 2048 --report"),
            0)
      << errors_;
  EXPECT_NE(printed_.find("50 % of it islands"), std::string::npos) << printed_;
  const Texels map = read_texels(file("out/G.o.exr"));
  ASSERT_EQ(map.width, 8);
  for (int x = 0; x < 8; ++x) {
    const float distance = 4.0f * (static_cast<float>(x) + 0.5f) / 8.0f;
    const float factor = 0.5f * (1.0f - distance / std::hypot(distance, 1.0f));
    EXPECT_NEAR(*map.at(x, 1), 1.0f - factor, 4e-3f) << x;
    EXPECT_EQ(*map.at(x, 0), *map.at(x, 1)) << "dilated";
  }
}

TEST_F(BakeMesh, JsonSaysHowManyTexelsAreCovered) {
  ASSERT_EQ(bake("<position name=\"n\" type=\"vector3\"/>", "vector3",
                 scene() + "--mesh floor --size 8x4 --json"),
            0)
      << errors_;
  const auto json = nlohmann::json::parse(printed_);
  EXPECT_EQ(json["files"][0]["covered_texels"], 16);
  EXPECT_EQ(json["files"][0]["channels"][0]["min"], 0.25);
  EXPECT_EQ(json["files"][0]["channels"][1]["max"], 0.0) << "what is dilated does not count";
}

TEST_F(BakeMesh, ReportsOverlapsAndTheFirstWins) {
  std::string text(floor_and_wall);
  text.replace(text.find("f 1/5 4/6 6/7 5/8"), 17, "f 1/1 4/2 6/3 5/4");
  ASSERT_EQ(bake("<position name=\"n\" type=\"vector3\"/>", "vector3", scene(text) + "--size 16"),
            0)
      << errors_;
  EXPECT_TRUE(says("warning: 128 texels")) << errors_;
  EXPECT_TRUE(says("[overlaps]") && says("floor and wall: 128")) << errors_;
  const Texels map = read_texels(file("out/G.o.exr"));
  for (int y = 8; y < 16; ++y) EXPECT_EQ(map.at(3, y)[1], 0.0f) << "of the floor";
}

TEST_F(BakeMesh, RefusesWhatHasNoMap) {
  const std::string position = "<position name=\"n\" type=\"vector3\"/>";
  EXPECT_EQ(bake(position, "vector3", scene("v 0 0 0\nv 1 0 0\nv 0 1 0\no bare\nf 1 2 3\n")), 1);
  EXPECT_TRUE(says("error: ") && says("[no-uv] (bare)")) << errors_;
  EXPECT_EQ(bake(position, "vector3", scene() + "--mesh door"), 1);
  EXPECT_TRUE(says("[unknown-mesh]") && says("floor, wall")) << errors_;
  EXPECT_EQ(bake(position, "vector3", scene() + "--size 4 --udim 1005"), 1);
  EXPECT_TRUE(says("[nothing-to-bake]")) << errors_;
  EXPECT_EQ(bake(position, "vector3", scene() + "--dilate much"), 2);
  EXPECT_EQ(bake(position, "vector3", "--mesh floor"), 2) << "without a scene";
  EXPECT_EQ(bake(position, "vector3", "--scene " + file("none.glb")), 1);
  EXPECT_FALSE(std::filesystem::exists(file("out/G.o.exr")));
}

TEST_F(BakeMesh, RefusesWhatDependsOnTheView) {
  const std::string view =
      "<viewdirection name=\"n\" type=\"vector3\"><input name=\"space\" "
      "type=\"string\" value=\"world\"/></viewdirection>";
  EXPECT_EQ(bake(view, "vector3", scene() + "--mesh floor --size 4"), 1);
  EXPECT_TRUE(says("a.mtlx:2:") && says("[view-dependent] (G/n)")) << errors_;
  EXPECT_FALSE(std::filesystem::exists(file("out/G.o.exr")));
  ASSERT_EQ(bake(view, "vector3", scene() + "--mesh floor --size 4 --view normal"), 0) << errors_;
  EXPECT_EQ(read_texels(file("out/G.o.exr")).at(1, 3)[1], -1.0f) << "from the viewer to the floor";
}

TEST_F(BakeMesh, SaysWhatMeshesDoNotHave) {
  ASSERT_EQ(bake(property("rust"), "float", scene() + "--mesh floor --size 4"), 0) << errors_;
  EXPECT_TRUE(says("a.mtlx:2:") && says("[missing-attribute] (G/n)")) << errors_;
  EXPECT_TRUE(says("geometric property 'rust'")) << errors_;
}

TEST_F(BakeMesh, TilesAreThoseOfTheMesh) {
  std::string text(floor_and_wall);
  for (const std::string_view uv : {"vt 0 0.6", "vt 1 0.6", "vt 1 1", "vt 0 1"}) {
    std::string moved(uv);
    moved[3] = moved[3] == '0' ? '2' : '3';  // u + 2
    text.replace(text.find("\n" + std::string(uv) + "\n") + 1, uv.size(), moved);
  }
  const std::string position = "<position name=\"n\" type=\"vector3\"/>";
  ASSERT_EQ(bake(position, "vector3", scene(text) + "--size 8 --udim auto"), 0) << errors_;
  EXPECT_EQ(errors_.find("warning"), std::string::npos) << errors_;
  EXPECT_EQ(names_in(file("out")), (std::set<std::string>{"G.o.1001.exr", "G.o.1003.exr"}));
  EXPECT_EQ(read_texels(file("out/G.o.1003.exr")).at(4, 0)[0], 0.0f) << "x of the wall";
  ASSERT_EQ(bake(position, "vector3", scene(text) + "--size 8"), 0) << errors_;
  EXPECT_TRUE(says("[udim-not-baked]")) << errors_;
}

/// Texture coordinates that only the second set has.
TEST_F(BakeMesh, AnotherSetOfCoordinates) {
  write("card.bin", host::card_data());
  const std::string card =
      "--scene " + write("a.gltf", host::spoiled_card("TEXCOORD_0", "TEXCOORD_1")) + " ";
  const std::string position = "<position name=\"n\" type=\"vector3\"/>";
  EXPECT_EQ(bake(position, "vector3", card), 1);
  EXPECT_TRUE(says("[no-uv]")) << errors_;
  ASSERT_EQ(bake(position, "vector3", card + "--uv-set 1 --size 4"), 0) << errors_;
  const Texels map = read_texels(file("out/G.o.exr"));
  EXPECT_NEAR(map.at(3, 0)[0], 0.875f, 1e-6f);
  EXPECT_NEAR(map.at(3, 0)[1], 0.875f, 1e-6f);
}

TEST_F(BakeMesh, FilesDoNotDependOnThreads) {
  const std::string options = scene() + "--size 33x21 --rays 32 --samples 4 --threads ";
  std::string first;
  for (const char* threads : {"1", "2", "7"}) {
    ASSERT_EQ(bake(property("bentnormal", "vector3"), "vector3", options + threads), 0) << errors_;
    const std::string bytes = text_of(file("out/G.o.exr"));
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first) << threads;
  }
}

/// A pattern of positions, and bumps of it, as procedures and as maps of the same ball.
TEST_F(BakeMesh, RendersAsTheProceduresThatWereBaked) {
  write("ball.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709"><nodegraph name="G">
    <position name="p" type="vector3"/>
    <fractal3d name="f" type="float"><input name="position" type="vector3" nodename="p"/>
      <input name="octaves" type="integer" value="2"/></fractal3d>
    <remap name="c" type="color3"><input name="in" type="color3" nodename="f3"/>
      <input name="inlow" type="color3" value="-1, -1, -1"/>
      <input name="outlow" type="color3" value="0.1, 0.2, 0.3"/>
      <input name="outhigh" type="color3" value="0.9, 0.7, 0.5"/></remap>
    <convert name="f3" type="color3"><input name="in" type="float" nodename="f"/></convert>
    <bump name="b" type="vector3"><input name="height" type="float" nodename="f"/>
      <input name="scale" type="float" value="0.05"/></bump>
    <output name="color" type="color3" nodename="c"/>
    <output name="normal" type="vector3" nodename="b"/></nodegraph>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="G" output="color"/>
    <input name="normal" type="vector3" nodegraph="G" output="normal"/>
    <input name="specular_roughness" type="float" value="0.5"/></standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>)");
  ASSERT_EQ(run("bake " + file("ball.mtlx") + " --no-cache --document " + file("out/m.mtlx") +
                " --scene builtin --mesh ball --size 512x256 --samples 4"),
            0)
      << errors_;
  const auto render = [&](const std::string& document, const std::string& image) {
    return run("render " + document + " --no-cache --material M --size 64 --spp 16 --out " +
               file(image));
  };
  ASSERT_EQ(render(file("ball.mtlx"), "direct.exr"), 0) << errors_;
  ASSERT_EQ(render(file("out/m.mtlx"), "baked.exr"), 0) << errors_;
  const Texels direct = read_texels(file("direct.exr")), baked = read_texels(file("baked.exr"));
  ASSERT_EQ(direct.values.size(), baked.values.size());
  double squares = 0.0, darker = 0.0;
  for (std::size_t i = 0; i < direct.values.size(); ++i) {
    const double a = std::min(1.0, static_cast<double>(direct.values[i]));
    const double b = std::min(1.0, static_cast<double>(baked.values[i]));
    squares += (a - b) * (a - b);
    darker += a < 0.999 ? 1.0 : 0.0;
  }
  const double psnr = -10.0 * std::log10(squares / static_cast<double>(direct.values.size()));
  EXPECT_GE(psnr, 40.0);
  EXPECT_GT(darker, 0.5 * static_cast<double>(direct.values.size()));
}

}  // namespace
}  // namespace nacre
