// What documents say about sides, holdouts and assignments, in rendered pictures.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

/// Two squares side by side: the camera that fits itself to them sees the front of /one
/// and the back of /two.
constexpr std::string_view squares = R"(
o one
v -2 -1 0
v -0.1 -1 0
v -0.1 1 0
v -2 1 0
f 1 2 3 4
o two
v 0.1 -1 0
v 2 -1 0
v 2 1 0
v 0.1 1 0
f 8 7 6 5
)";

/// A material M that glows red in front and green behind, and a blue one, N.
constexpr std::string_view materials = R"(
  <uniform_edf name="red" type="EDF"><input name="color" type="color3" value="1, 0, 0"/></uniform_edf>
  <uniform_edf name="green" type="EDF"><input name="color" type="color3" value="0, 1, 0"/></uniform_edf>
  <uniform_edf name="blue" type="EDF"><input name="color" type="color3" value="0, 0, 1"/></uniform_edf>
  <oren_nayar_diffuse_bsdf name="grey" type="BSDF"/>
  <surface name="front" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="grey"/><input name="edf" type="EDF" nodename="red"/>
  </surface>
  <surface name="back" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="grey"/><input name="edf" type="EDF" nodename="green"/>
    THIN
  </surface>
  <surface name="other" type="surfaceshader"><input name="edf" type="EDF" nodename="blue"/></surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="front"/>
    <input name="backsurfaceshader" type="surfaceshader" nodename="back"/>
  </surfacematerial>
  <surfacematerial name="N" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="other"/>
  </surfacematerial>
  <volumematerial name="V" type="material"/>)";

constexpr std::string_view thin = R"(<input name="thin_walled" type="boolean" value="true"/>)";

struct Seen {
  int red = 0, green = 0, blue = 0;  ///< Pixels of exactly that colour.
  int held_out = 0;                  ///< Black with alpha 0.
  int channels = 0;
};

class Render : public Tool {
 protected:
  void write_document(std::string_view walls, std::string_view look) {
    std::string text(materials);
    text.replace(text.find("THIN"), 4, walls);
    write("a.mtlx", "<materialx version=\"1.39\" colorspace=\"lin_rec709\">" + text +
                        std::string(look) + "</materialx>");
  }

  /// Emission only, so that every pixel inside a square has exactly its colour.
  Seen seen(std::string_view walls, std::string_view look = "") {
    write_document(walls, look);
    write("a.obj", squares);
    EXPECT_EQ(run("render " + file("a.mtlx") + " --scene " + file("a.obj") +
                  (look.empty() ? " --material M" : "") +
                  " --size 48x32 --spp 1 --max-depth 0 --out " + file("a.exr")),
              0)
        << errors_;
    const auto in = OIIO::ImageInput::open(file("a.exr"));
    if (in == nullptr) return {};
    Seen seen{.channels = in->spec().nchannels};
    const auto channels = static_cast<std::size_t>(seen.channels);
    std::vector<float> texels(48 * 32 * channels);
    in->read_image(0, 0, 0, seen.channels, OIIO::TypeDesc::FLOAT, texels.data());
    for (std::size_t i = 0; i < texels.size(); i += channels) {
      const auto is = [&](float r, float g, float b) {
        return texels[i] == r && texels[i + 1] == g && texels[i + 2] == b;
      };
      seen.red += is(1, 0, 0);
      seen.green += is(0, 1, 0);
      seen.blue += is(0, 0, 1);
      seen.held_out += is(0, 0, 0) && channels == 4 && texels[i + 3] == 0.0f;
    }
    return seen;
  }
};

TEST_F(Render, ThinWallsHaveTwoSides) {
  const Seen both = seen(thin);
  EXPECT_GT(both.red, 100);
  EXPECT_GT(both.green, 100);
  EXPECT_EQ(both.channels, 3);
  EXPECT_EQ(errors_, "");
}

// PBS 1.39, "Surfaces": if both sides are connected but none of the shaders are
// thin-walled the front shader is used.
TEST_F(Render, SolidsShowTheirFrontOnBothSides) {
  const Seen both = seen("");
  EXPECT_EQ(both.green, 0);
  EXPECT_GT(both.red, 200);
  EXPECT_TRUE(says("back-not-shown")) << errors_;
  run("check " + file("a.mtlx"));
  EXPECT_TRUE(says("back-not-shown")) << errors_;
}

TEST_F(Render, TheCameraDoesNotSeeTheBackOfWhatIsNotTwoSided) {
  const Seen both = seen(thin, R"(<look name="l">
    <materialassign name="m" material="M" geom="/"/>
    <propertyassign name="p" property="twosided" type="boolean" value="false" geom="/"/>
  </look>)");
  EXPECT_GT(both.red, 100);
  EXPECT_EQ(both.green, 0);
}

TEST_F(Render, WhatIsSaidOfAMeshItselfCountsMore) {
  const Seen both = seen(thin, R"(
  <propertyset name="seen"><property name="twosided" type="boolean" value="true"/></propertyset>
  <look name="l">
    <materialassign name="m" material="M" geom="/"/>
    <propertysetassign name="q" propertyset="seen" geom="/two"/>
    <propertyassign name="p" property="twosided" type="boolean" value="false" geom="/"/>
    <propertyassign name="o" property="twosided" target="another" type="boolean" value="false"
                    geom="/two"/>
  </look>)");
  EXPECT_GT(both.green, 100);
}

TEST_F(Render, MattesHoldOut) {
  const Seen both = seen(thin, R"(<look name="l">
    <materialassign name="m" material="M" geom="/"/>
    <propertyassign name="p" property="matte" type="boolean" value="true" geom="/one"/>
  </look>)");
  EXPECT_EQ(both.channels, 4);
  EXPECT_EQ(both.red, 0);
  EXPECT_GT(both.held_out, 100);
  EXPECT_GT(both.green, 100);
}

// Geometry Extensions, "MaterialAssign Elements".
TEST_F(Render, AssignmentsThatAreNotExclusiveLetOtherSurfacesThrough) {
  const auto assign = [](std::string_view exclusive) {
    return R"(<look name="l">
      <materialassign name="m" material="N" geom="/"/>
      <materialassign name="n" material="M" geom="/one"/>
      <materialassign name="v" material="V" geom="/one" exclusive=")" +
           std::string(exclusive) + R"("/></look>)";
  };
  const Seen both = seen(thin, assign("false"));
  EXPECT_GT(both.red, 100);   // V has no surface: M's.
  EXPECT_GT(both.blue, 100);  // /two has N alone.
  EXPECT_EQ(errors_, "");
  write_document(thin, assign("true"));
  EXPECT_EQ(run("render " + file("a.mtlx") + " --scene " + file("a.obj") + " --size 8 --out " +
                file("a.exr")),
            1);
  EXPECT_TRUE(says("no-surface")) << errors_;
}

/// Two cards, the second moved and turned, of which the first has an attribute "_TINT": white.
std::string two_cards() {
  std::string data;
  const auto add = [&data](std::initializer_list<float> values) {
    for (const float v : values) data.append(reinterpret_cast<const char*>(&v), sizeof v);
  };
  add({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0});
  add({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
  add({0, 4});                          // Bytes 144-151: times,
  add({-1.1f, 0, 0, -1.1f, 0, 0});      // 152-175: where the first card is anyway,
  add({-1.5f, 0.1f, 0, -0.5f, -1, 1});  // 176-199: and where it is not.
  return data;
}

/// An animation of the first card's place: accessor 3 is where it is, 4 where it is not.
std::string animated(std::string_view json, int output) {
  std::string text(json);
  const auto put = [&text](std::string_view before, std::string_view what) {
    text.insert(text.find(before), what);
  };
  put("\"nodes\": [{\"name\"",
      "\"animations\": [{\"samplers\": [{\"input\": 2, \"output\": " + std::to_string(output) +
          R"(}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}], )");
  put("],\n  \"accessors\"", R"(, {"buffer": 0, "byteOffset": 144, "byteLength": 8},
      {"buffer": 0, "byteOffset": 152, "byteLength": 24},
      {"buffer": 0, "byteOffset": 176, "byteLength": 24})");
  text.insert(text.rfind("]\n}"),
              R"(, {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                 {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"},
                 {"bufferView": 4, "componentType": 5126, "count": 2, "type": "VEC3"})");
  return text;
}

constexpr std::string_view two_cards_json = R"({
  "asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
  "nodes": [{"name": "one", "mesh": 0, "translation": [-1.1, 0, 0]},
            {"name": "two", "mesh": 1, "translation": [1.1, 0, 0], "rotation": [0, 0, 1, 0]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_TINT": 1}}]},
             {"primitives": [{"attributes": {"POSITION": 0}}]}],
  "buffers": [{"byteLength": 200, "uri": "cards.bin"}],
  "bufferViews": [{"buffer": 0, "byteLength": 72}, {"buffer": 0, "byteOffset": 72, "byteLength": 72}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC3"}]
})";

class Cards : public Render {
 protected:
  /// The texels of the cards glowing in the colour that `nodes` call "c".
  std::vector<float> glowing(std::string_view nodes, std::string_view options = "",
                             std::string_view scene = two_cards_json) {
    write("cards.bin", two_cards());
    write("a.gltf", scene);
    write("a.mtlx", R"(<materialx version="1.39" colorspace="lin_rec709">)" + std::string(nodes) +
                        R"(<uniform_edf name="e" type="EDF">
          <input name="color" type="color3" nodename="c"/></uniform_edf>
        <surface name="s" type="surfaceshader">
          <input name="edf" type="EDF" nodename="e"/></surface>
        <surfacematerial name="M" type="material">
          <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
      </materialx>)");
    EXPECT_EQ(run("render " + file("a.mtlx") + " --scene " + file("a.gltf") +
                  " --size 48x32 --spp 1 --max-depth 0 --out " + file("a.exr") + ' ' +
                  std::string(options)),
              0)
        << errors_;
    std::vector<float> texels(48 * 32 * 3);
    const auto in = OIIO::ImageInput::open(file("a.exr"));
    if (in != nullptr) in->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, texels.data());
    return texels;
  }
};

// Whether a mesh has an attribute is a question of each point: both are shaded together.
TEST_F(Cards, SomeHaveAnAttributeAndOthersItsDefault) {
  const std::vector<float> texels = glowing(
      R"(<geompropvalue name="c" type="color3"><input name="geomprop" type="string" value="TINT"/>
         <input name="default" type="color3" value="0, 0, 1"/></geompropvalue>)");
  int white = 0, blue = 0;
  for (std::size_t i = 0; i < texels.size(); i += 3) {
    const bool is_left = i / 3 % 48 < 24;
    white += is_left && texels[i] == 1 && texels[i + 1] == 1 && texels[i + 2] == 1;
    blue += !is_left && texels[i] == 0 && texels[i + 1] == 0 && texels[i + 2] == 1;
  }
  EXPECT_GT(white, 100);
  EXPECT_GT(blue, 100);
}

// P taken to object space is the position in object space, of each card by its own matrix.
TEST_F(Cards, MatricesAreThoseOfTheObject) {
  constexpr std::string_view own =
      R"(<position name="p" type="vector3"><input name="space" type="string" value="object"/>
         </position><convert name="c" type="color3"><input name="in" type="vector3" nodename="p"/>
         </convert>)";
  constexpr std::string_view from_world =
      R"(<position name="w" type="vector3"><input name="space" type="string" value="world"/>
         </position><transformpoint name="p" type="vector3">
         <input name="in" type="vector3" nodename="w"/>
         <input name="fromspace" type="string" value="world"/>
         <input name="tospace" type="string" value="object"/></transformpoint>
         <convert name="c" type="color3"><input name="in" type="vector3" nodename="p"/></convert>)";
  const std::string moving = animated(two_cards_json, 4);
  for (const auto& [options, scene] :
       {std::pair<std::string_view, std::string_view>{"", two_cards_json},
        {"--time 2 --shutter -2 2", moving}}) {
    const std::vector<float> direct = glowing(own, options, scene);
    const std::vector<float> changed = glowing(from_world, options, scene);
    int bright = 0;
    for (std::size_t i = 0; i < direct.size(); ++i) {
      EXPECT_NEAR(direct[i], changed[i], 2e-6f) << i;
      bright += direct[i] > 0.5f;
    }
    EXPECT_GT(bright, 100);
  }
}

constexpr std::string_view time_and_frame =
    R"(<time name="t" type="float"/><frame name="f" type="float"/>
       <combine3 name="c" type="color3"><input name="in1" type="float" nodename="t"/>
       <input name="in2" type="float" nodename="f"/></combine3>)";

TEST_F(Cards, TimeIsThatOfTheRay) {
  const std::vector<float> closed = glowing(time_and_frame, "--time 3 --frame 20");
  const std::vector<float> open =
      glowing(time_and_frame, "--time 3 --frame 20 --fps 10 --shutter -1 0.5");
  double sum = 0, lit = 0;
  float least = INFINITY, most = 0;
  for (std::size_t i = 0; i < open.size(); i += 3) {
    EXPECT_EQ(closed[i] == 3.0f, closed[i + 1] == 20.0f);
    if (closed[i] != 3.0f) continue;  // The sky, in both.
    EXPECT_NEAR(open[i + 1], 20 + 10 * (open[i] - 3), 1e-4f);
    sum += double{open[i]};
    least = std::min(least, open[i]), most = std::max(most, open[i]);
    ++lit;
  }
  ASSERT_GT(lit, 300);
  EXPECT_GE(least, 2.0f);
  EXPECT_LE(most, 3.5f);
  // Even between 2 and 3.5, one each of so many: four standard deviations.
  EXPECT_NEAR(sum / lit, 2.75, 4 * 1.5 / std::sqrt(12 * lit));
}

// The shutter is open for what does not move: not a bit is different.
TEST_F(Cards, WhatStandsStillIsAsWithoutAnAnimation) {
  constexpr std::string_view grey =
      R"(<position name="p" type="vector3"><input name="space" type="string" value="object"/>
         </position><convert name="c" type="color3"><input name="in" type="vector3" nodename="p"/>
         </convert>)";
  const std::vector<float> without = glowing(grey);
  EXPECT_EQ(glowing(grey, "", animated(two_cards_json, 3)), without);
  EXPECT_EQ(glowing(grey, "--time 2 --shutter -1 1", animated(two_cards_json, 3)), without);
  EXPECT_NE(glowing(grey, "--time 2 --shutter -1 1", animated(two_cards_json, 4)), without);
  EXPECT_EQ(run("render " + file("a.mtlx") + " --shutter 1 0 --out " + file("b.exr")), 2);
  EXPECT_TRUE(says("it closes before it opens")) << errors_;
}

}  // namespace
}  // namespace nacre
