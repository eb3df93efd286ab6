#include <OpenImageIO/imageio.h>

#include <cmath>
#include <filesystem>

#include "examples/common/srgb.h"
#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

// All four families of shading models, a displacement, a back side and a volume;
// inputs fed by graphs, by nodes at the root, through interfaces, by constants.
constexpr std::string_view materials = R"(<?xml version="1.0"?>
<materialx version="1.39" colorspace="lin_rec709">
  <nodegraph name="NG">
    <input name="tint" type="color3" value="0.9, 0.5, 0.2" />
    <texcoord name="uv" type="vector2" />
    <separate2 name="xy" type="multioutput">
      <input name="in" type="vector2" nodename="uv" />
    </separate2>
    <fractal3d name="bumps" type="float" />
    <range name="grey" type="float">
      <input name="in" type="float" nodename="bumps" />
      <input name="inlow" type="float" value="-1.5" />
      <input name="inhigh" type="float" value="1.5" />
      <input name="doclamp" type="boolean" value="true" />
    </range>
    <multiply name="color" type="color3">
      <input name="in1" type="color3" interfacename="tint" />
      <input name="in2" type="float" nodename="grey" />
    </multiply>
    <combine3 name="tilted" type="vector3">
      <input name="in1" type="float" nodename="xy" output="outx" />
      <input name="in2" type="float" nodename="xy" output="outy" />
      <input name="in3" type="float" value="1" />
    </combine3>
    <normalize name="direction" type="vector3">
      <input name="in" type="vector3" nodename="tilted" />
    </normalize>
    <multiply name="ior" type="float">
      <input name="in1" type="float" nodename="grey" />
      <input name="in2" type="float" value="3" />
    </multiply>
    <output name="color_out" type="color3" nodename="color" />
    <output name="grey_out" type="float" nodename="grey" />
    <output name="normal_out" type="vector3" nodename="direction" />
    <output name="ior_out" type="float" nodename="ior" />
    <output name="tint_out" type="color3" interfacename="tint" />
  </nodegraph>
  <noise2d name="loose" type="vector3" />
  <standard_surface name="SS" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="color_out" />
    <input name="specular_IOR" type="float" nodegraph="NG" output="ior_out" />
    <input name="normal" type="vector3" nodegraph="NG" output="normal_out" />
    <input name="specular_color" type="color3" value="0.2, 0.3, 0.4" colorspace="srgb_texture" />
    <input name="coat_color" type="color3" nodegraph="NG" output="tint_out" />
  </standard_surface>
  <open_pbr_surface name="OP" type="surfaceshader">
    <input name="specular_roughness" type="float" nodegraph="NG" output="grey_out" />
    <input name="geometry_tangent" type="vector3" nodegraph="NG" output="normal_out" />
  </open_pbr_surface>
  <gltf_pbr name="GL" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="color_out" />
    <input name="normal" type="vector3" nodegraph="NG" output="normal_out" />
  </gltf_pbr>
  <UsdPreviewSurface name="UP" type="surfaceshader">
    <input name="diffuseColor" type="color3" nodegraph="NG" output="color_out" />
    <input name="roughness" type="float" nodegraph="NG" output="grey_out" />
  </UsdPreviewSurface>
  <displacement name="D" type="displacementshader">
    <input name="displacement" type="vector3" nodename="loose" />
    <input name="scale" type="float" value="0.1" />
  </displacement>
  <nodegraph name="NG_volume">
    <noise3d name="cloud" type="vector3" />
    <absorption_vdf name="fog" type="VDF">
      <input name="absorption" type="vector3" nodename="cloud" />
    </absorption_vdf>
    <volume name="v" type="volumeshader">
      <input name="vdf" type="VDF" nodename="fog" />
    </volume>
    <output name="out" type="volumeshader" nodename="v" />
  </nodegraph>
  <surfacematerial name="M1" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SS" />
    <input name="backsurfaceshader" type="surfaceshader" nodename="OP" />
    <input name="displacementshader" type="displacementshader" nodename="D" />
  </surfacematerial>
  <surfacematerial name="M2" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="GL" />
  </surfacematerial>
  <surfacematerial name="M3" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="UP" />
  </surfacematerial>
  <volumematerial name="M4" type="material">
    <input name="volumeshader" type="volumeshader" nodegraph="NG_volume" output="out" />
  </volumematerial>
</materialx>
)";

struct Pair {
  std::string before;  // an output of the document
  std::string after;   // that of the baked document
};

const std::vector<Pair> colors = {
    {"NG/color_out", "NG_baked_SS/base_color_output"},
    {"NG/color_out", "NG_baked_GL/base_color_output"},
    {"NG/color_out", "NG_baked_UP/diffuseColor_output"},
};
const std::vector<Pair> greys = {
    {"NG/grey_out", "NG_baked_OP/specular_roughness_output"},
    {"NG/grey_out", "NG_baked_UP/roughness_output"},
};
const std::vector<Pair> wide = {
    {"NG/ior_out", "NG_baked_SS/specular_IOR_output"},
    {"loose", "NG_baked_D/displacement_output"},
    {"NG_volume/cloud_for_test", "NG_baked_NG_volume_fog/absorption_output"},
};
const std::vector<Pair> directions = {
    {"NG/normal_out", "NG_baked_SS/normal_output"},
    {"NG/normal_out", "NG_baked_OP/geometry_tangent_output"},
    {"NG/normal_out", "NG_baked_GL/normal_output"},
};

class BakeDocument : public Tool {
 protected:
  // A power of two: texel centres and the weights between them are exact.
  static constexpr int size = 32;

  void bake(const std::string& options) {
    // The graph of the volume has no numeric output of its own to compare with.
    std::string text(materials);
    const std::string mark = "<output name=\"out\" type=\"volumeshader\"";
    text.insert(text.find(mark),
                "<output name=\"cloud_for_test\" type=\"vector3\" "
                "nodename=\"cloud\" />");
    const std::string from = write("from.mtlx", text);
    ASSERT_EQ(run("bake " + from + " --no-cache --document " + file("baked.mtlx") + " --out " +
                  file("textures") + " --size 32 " + options),
              0)
        << errors_;
    // The noise in three dimensions reads the position, which is the plane's.
    for (std::size_t line = 0; line < errors_.size(); line = errors_.find('\n', line) + 1) {
      const std::string one = errors_.substr(line, errors_.find('\n', line) - line);
      EXPECT_NE(one.find("[plane-geometry]"), std::string::npos) << one;
    }
    before_ = read(from);
    after_ = read(file("baked.mtlx"));
  }

  /// The largest difference between texels, coded as sRGB or not.
  double difference(const Pair& pair, bool coded) {
    const std::vector<float> a = values(*before_, pair.before, size);
    const std::vector<float> b = values(*after_, pair.after, size);
    EXPECT_EQ(a.size(), b.size());
    EXPECT_GT(*std::max_element(a.begin(), a.end()) - *std::min_element(a.begin(), a.end()), 0.1);
    double most = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      const double one = coded ? host::srgb_encode(a[i]) : a[i];
      const double two = coded ? host::srgb_encode(b[i]) : b[i];
      most = std::max(most, std::abs(one - two));
    }
    return most;
  }

  std::unique_ptr<Document> before_, after_;
};

TEST_F(BakeDocument, FloatTexturesGiveTheSameValues) {
  bake("--format exr");
  ASSERT_NE(after_, nullptr);
  for (const auto* pairs : {&colors, &greys, &wide}) {
    for (const Pair& pair : *pairs) EXPECT_EQ(difference(pair, false), 0) << pair.after;
  }
  // (v + 1) / 2 and back are two roundings at 1, the normalisation a few more.
  for (const Pair& pair : directions) EXPECT_LT(difference(pair, false), 1e-6) << pair.after;
}

TEST_F(BakeDocument, TiledTexturesGiveTheSameValues) {
  bake("--format tx");
  ASSERT_NE(after_, nullptr);
  for (const Pair& pair : wide) EXPECT_EQ(difference(pair, false), 0) << pair.after;
}

TEST_F(BakeDocument, ConstantsAreValues) {
  bake("--format exr");
  ASSERT_NE(after_, nullptr);
  const Element& shader = *after_->root().child("SS");
  EXPECT_EQ(shader.child("coat_color")->attribute("value"), "0.9, 0.5, 0.2");
  EXPECT_EQ(shader.child("specular_color")->attribute("value"), "0.2, 0.3, 0.4");
  EXPECT_EQ(shader.child("specular_color")->attribute("colorspace"), "srgb_texture");
  EXPECT_EQ(after_->root().child("D")->child("scale")->attribute("value"), "0.1");
  EXPECT_FALSE(fs::exists(file("textures/SS.coat_color.exr")));
}

TEST_F(BakeDocument, MaterialsKeepTheirShaders) {
  bake("--format exr");
  ASSERT_NE(after_, nullptr);
  const Element& m1 = *after_->root().child("M1");
  EXPECT_EQ(m1.child("surfaceshader")->attribute("nodename"), "SS");
  EXPECT_EQ(m1.child("backsurfaceshader")->attribute("nodename"), "OP");
  EXPECT_EQ(m1.child("displacementshader")->attribute("nodename"), "D");
  const Element& m4 = *after_->root().child("M4");
  EXPECT_EQ(m4.child("volumeshader")->attribute("nodename"), "NG_volume_v");
  const Element& v = *after_->root().child("NG_volume_v");
  EXPECT_EQ(v.child("vdf")->attribute("nodename"), "NG_volume_fog");
  run("check " + file("baked.mtlx"));  // Warns that no displacement or volume is traced.
  EXPECT_EQ(errors_.find("error:"), std::string::npos) << errors_;
  EXPECT_EQ(run("render " + file("baked.mtlx") + " --no-cache --material M1 --spp 1 --size 8x8 " +
                "--out " + file("baked.exr")),
            0)
      << errors_;
}

TEST_F(BakeDocument, ColourSpacesAreTagged) {
  bake("--format exr");
  const auto space = [&] {
    const Element& graph = *after_->root().child("NG_baked_GL");
    return std::string(graph.child("base_color_image")->child("file")->attribute("colorspace"));
  };
  ASSERT_NE(after_, nullptr);
  EXPECT_EQ(space(), "lin_rec709");
  bake("--format png --material M2");
  ASSERT_NE(after_, nullptr);
  EXPECT_EQ(space(), "srgb_texture");
  const Element& normal = *after_->root().child("NG_baked_GL")->child("normal_image");
  EXPECT_FALSE(normal.child("file")->has_attribute("colorspace"));
}

struct Depth {
  const char* options;
  int steps;
};

class WholeNumbers : public BakeDocument, public ::testing::WithParamInterface<Depth> {};

// Rounding to n steps is half a step off in the numbers that are stored; a
// direction is off by at most that in three components of half its range, and by
// twice as much once its length is 1 again.
TEST_P(WholeNumbers, AreHalfAStepOff) {
  const double half = 0.5 / GetParam().steps + 2e-6;
  bake(std::string(GetParam().options) + " --material M2");
  ASSERT_NE(after_, nullptr);
  EXPECT_LT(difference(colors[1], true), half);
  EXPECT_GT(difference(colors[1], true), 0.5 * half);
  EXPECT_LT(difference(directions[2], false), 2 * std::sqrt(3.0) * 2 * half);
  bake(std::string(GetParam().options) + " --material M3");
  ASSERT_NE(after_, nullptr);
  EXPECT_LT(difference(greys[1], false), half);
}

INSTANTIATE_TEST_SUITE_P(Depths, WholeNumbers,
                         ::testing::Values(Depth{"--format png", 255}, Depth{"--bitdepth 8", 255},
                                           Depth{"--format png --bitdepth 16", 65535}));

TEST_F(BakeDocument, ValuesThatAFileCannotHoldAreAnError) {
  write("from.mtlx", materials);
  EXPECT_EQ(run("bake " + file("from.mtlx") + " --no-cache --format png --size 32 --material M1 " +
                "--document " + file("baked.mtlx") + " --out " + folder_.path().string()),
            1);
  EXPECT_NE(errors_.find("out-of-range"), std::string::npos) << errors_;
  EXPECT_FALSE(fs::exists(file("baked.mtlx")));
}

/// A document says how long a chain of closures is; the stack does not.
// Cut off, where that is asked for, as outputs are.
TEST_F(BakeDocument, ValuesThatAFileCannotHoldAreCutOffByClip) {
  write("a.mtlx",
        "<materialx version=\"1.39\"><nodegraph name=\"G\"><texcoord name=\"t\" "
        "type=\"vector2\"/><extract name=\"x\" type=\"float\"><input name=\"in\" "
        "type=\"vector2\" nodename=\"t\"/></extract><multiply name=\"m\" "
        "type=\"float\"><input name=\"in1\" type=\"float\" nodename=\"x\"/><input "
        "name=\"in2\" type=\"float\" value=\"2\"/></multiply><output name=\"o\" "
        "type=\"float\" nodename=\"m\"/><output name=\"p\" type=\"float\" "
        "nodename=\"m\"/></nodegraph><standard_surface name=\"S\" "
        "type=\"surfaceshader\"><input name=\"base\" type=\"float\" "
        "nodegraph=\"G\" output=\"o\"/><input name=\"coat\" type=\"float\" "
        "nodegraph=\"G\" output=\"p\"/></standard_surface><surfacematerial "
        "name=\"M\" type=\"material\"><input name=\"surfaceshader\" "
        "type=\"surfaceshader\" nodename=\"S\"/></surfacematerial></materialx>");
  const std::string bake = "bake " + file("a.mtlx") +
                           " --no-cache --size 8 --format png --document " + file("out/b.mtlx");
  EXPECT_EQ(run(bake), 1);
  EXPECT_EQ(run(bake + " --clip"), 0) << errors_;
  EXPECT_TRUE(says("warning: what the texture cannot hold was cut off")) << errors_;
  // Two outputs of one node are one file.
  EXPECT_EQ(names_in(file("out")), (std::set<std::string>{"S.base.png", "b.mtlx"}));
}

TEST_F(BakeDocument, ChainsOfClosuresOfAnyLength) {
  std::string text = R"(<materialx version="1.39"><nodegraph name="G">
    <noise2d name="n" type="color3"/><output name="o" type="color3" nodename="n"/></nodegraph>
    <oren_nayar_diffuse_bsdf name="b0" type="BSDF">
      <input name="color" type="color3" nodegraph="G" output="o"/></oren_nayar_diffuse_bsdf>)";
  constexpr int length = 50'000;
  for (int i = 1; i <= length; ++i) {
    text += fmt::format(R"(<multiply name="b{}" type="BSDF">
      <input name="in1" type="BSDF" nodename="b{}"/>
      <input name="in2" type="float" value="1"/></multiply>)",
                        i, i - 1);
  }
  text += fmt::format(R"(<surface name="S" type="surfaceshader">
    <input name="bsdf" type="BSDF" nodename="b{}"/></surface>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    </materialx>)",
                      length);
  write("from.mtlx", text);
  EXPECT_EQ(
      run("bake " + file("from.mtlx") + " --no-cache --size 4 --document " + file("baked.mtlx")), 0)
      << errors_;
  const auto baked = read(file("baked.mtlx"));
  ASSERT_NE(baked, nullptr);
  const Element* last = baked->root().child(fmt::format("b{}", length));
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(last->child("in1")->attribute("nodename"), fmt::format("b{}", length - 1));
}

class BakeOutput : public Tool {
 protected:
  int bake(const std::string& attributes, const std::string& options) {
    const std::string from =
        write("o.mtlx",
              "<materialx version=\"1.39\"><nodegraph name=\"G\">"
              "<noise2d name=\"n\" type=\"color3\"/><output name=\"o\" type=\"color3\" "
              "nodename=\"n\" " +
                  attributes + "/></nodegraph></materialx>");
    return run("bake " + from + " --no-cache --out " + folder_.path().string() + " " + options);
  }
  OIIO::ImageSpec spec(const std::string& name) {
    const auto image = OIIO::ImageInput::open(file(name));
    EXPECT_NE(image, nullptr) << OIIO::geterror();
    return image != nullptr ? image->spec() : OIIO::ImageSpec();
  }
};

TEST_F(BakeOutput, SaysItsSizeAndDepth) {
  ASSERT_EQ(bake("width=\"24\" height=\"10\" bitdepth=\"16\"", ""), 0) << errors_;
  const OIIO::ImageSpec half = spec("G.o.exr");
  EXPECT_EQ(half.width, 24);
  EXPECT_EQ(half.height, 10);
  EXPECT_EQ(half.format, OIIO::TypeDesc::HALF);
  ASSERT_EQ(bake("width=\"24\" height=\"10\" bitdepth=\"8\"", ""), 0) << errors_;
  EXPECT_EQ(spec("G.o.png").format, OIIO::TypeDesc::UINT8);
}

TEST_F(BakeOutput, TheCommandLineHasTheLastWord) {
  ASSERT_EQ(
      bake("width=\"24\" height=\"10\" bitdepth=\"16\"", "--size 6x5 --bitdepth 32 --format exr"),
      0)
      << errors_;
  EXPECT_EQ(spec("G.o.exr").width, 6);
  EXPECT_EQ(spec("G.o.exr").height, 5);
  EXPECT_EQ(spec("G.o.exr").format, OIIO::TypeDesc::FLOAT);
}

TEST_F(BakeOutput, SaysItsColourSpace) {
  const auto first_row = [&] {
    std::vector<float> row(8 * 3);
    const auto image = OIIO::ImageInput::open(file("G.o.exr"));
    image->read_scanline(0, 0, OIIO::TypeDesc::FLOAT, row.data());
    return row;
  };
  ASSERT_EQ(bake("", "--size 8"), 0) << errors_;
  const std::vector<float> linear = first_row();
  ASSERT_EQ(bake("colorspace=\"srgb_texture\"", "--size 8"), 0) << errors_;
  const std::vector<float> coded = first_row();
  for (std::size_t i = 0; i < linear.size(); ++i) {
    EXPECT_EQ(coded[i], host::srgb_encode(linear[i]));
  }
}

TEST_F(BakeOutput, WhatCannotBeIsAnError) {
  EXPECT_EQ(bake("bitdepth=\"8\"", "--size 4 --format exr"), 1);
  EXPECT_NE(errors_.find("a exr file does not hold 8-bit channels"), std::string::npos) << errors_;
  EXPECT_EQ(bake("bitdepth=\"32\"", "--size 4 --format png"), 1);
  EXPECT_EQ(bake("bitdepth=\"12\"", "--size 4"), 1);
  EXPECT_EQ(bake("width=\"0\"", ""), 1);
  EXPECT_EQ(bake("colorspace=\"nowhere\"", "--size 4"), 1);
  EXPECT_NE(errors_.find("unknown-colorspace"), std::string::npos) << errors_;
  EXPECT_EQ(bake("", "--size 4 --bitdepth 12"), 2);
  EXPECT_EQ(bake("", "--size none"), 2);
}

}  // namespace
}  // namespace nacre
