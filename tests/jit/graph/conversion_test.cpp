#include <gtest/gtest.h>

#include "jit/graph/color/colorspace.h"
#include "tests/jit/graph/build_text.h"

namespace nacre {
namespace {

// The transforms as single nodes, so that texts stay short.
GraphOptions native_transforms() {
  GraphOptions options;
  options.is_native = [](std::string_view name) {
    const Definitions& known = standard_library().definitions();
    const NodeDef* nodedef = known.nodedef(name);  // null: the document's own
    return name.find("_to_lin_rec709") != std::string_view::npos || nodedef == nullptr ||
           known.graph_of(*nodedef) == nullptr;
  };
  return options;
}

constexpr std::string_view red = R"(
  <constant name="c" type="color3">
    <input name="value" type="color3" value="1, 0, 0"/>
  </constant>
  <output name="out" type="color3" nodename="c"/>)";

TEST(Colour, WorkingSpaceAndUntaggedValuesStay) {
  const std::string plain =
      "parameter 0 color3 \"c/value\" = [1, 0, 0]\n"
      "%0 = ND_constant_color3(value=$0) : color3\n"
      "output \"out\" color3 = %0\n";
  EXPECT_EQ(text_of(red, {"out"}), plain);
  const std::string tagged = text_of(red, {"out"}, {}, "colorspace=\"lin_rec709\"");
  EXPECT_EQ(tagged.find("_to_"), std::string::npos) << tagged;
}

TEST(Colour, NearestColorspaceUpTheTreeCounts) {
  EXPECT_EQ(text_of(red, {"out"}, native_transforms(), "colorspace=\"acescg\""),
            "parameter 0 color3 \"c/value\" = [1, 0, 0] @acescg\n"
            "%0 = ND_acescg_to_lin_rec709_color3(in=$0) : color3\n"
            "%1 = ND_constant_color3(value=%0) : color3\n"
            "output \"out\" color3 = %1\n");
  const std::string_view tagged = R"(
    <constant name="c" type="color3">
      <input name="value" type="color3" value="1, 0, 0" colorspace="none"/>
    </constant>
    <output name="out" type="color3" nodename="c"/>)";
  const std::string text = text_of(tagged, {"out"}, {}, "colorspace=\"acescg\"");
  EXPECT_EQ(text.find("acescg"), std::string::npos) << text;
}

TEST(Colour, TransformsAreInlinedLikeAnyGraph) {
  const Graph graph = graph_of(red, {"out"}, {}, "colorspace=\"srgb_texture\"");
  EXPECT_GT(graph.nodes.size(), 5u);
  for (const GraphNode& node : graph.nodes) EXPECT_EQ(node.nodedef.find("_to_"), std::string::npos);
}

TEST(Colour, FilesConvertColourOutputsOnly) {
  const std::string text = text_of(R"(
    <image name="a" type="color4">
      <input name="file" type="filename" value="a.png" colorspace="srgb_texture"/>
    </image>
    <image name="b" type="vector3">
      <input name="file" type="filename" value="b.png" colorspace="srgb_texture"/>
    </image>
    <output name="out_a" type="color4" nodename="a"/>
    <output name="out_b" type="vector3" nodename="b"/>)",
                                   {"out_a", "out_b"}, native_transforms());
  EXPECT_NE(text.find("%2 = ND_srgb_texture_to_lin_rec709_color4(in=%1) : color4"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("file=\"a.png\"@srgb_texture"), std::string::npos) << text;
  EXPECT_NE(text.find("output \"out_b\" vector3 = %3"), std::string::npos) << text;
}

TEST(Colour, FileOnAnInterfaceKeepsItsOwnSpace) {
  const std::string text = text_of(R"(
    <nodegraph name="NG">
      <input name="file" type="filename" value="a.png" colorspace="g22_rec709"/>
      <tiledimage name="i" type="color3">
        <input name="file" type="filename" interfacename="file"/>
      </tiledimage>
      <output name="out" type="color3" nodename="i"/>
    </nodegraph>)",
                                   {"NG/out"}, native_transforms(), "colorspace=\"lin_rec709\"");
  EXPECT_NE(text.find("ND_g22_rec709_to_lin_rec709_color3"), std::string::npos) << text;
}

TEST(Colour, DefaultsOfNodeDefsCarryTheirSpace) {
  const std::string text = text_of(R"(
    <nodedef name="ND_x" node="x" colorspace="acescg">
      <input name="in" type="color3" value="1, 0, 0"/>
      <output name="out" type="color3"/>
    </nodedef>
    <nodegraph name="NG_x" nodedef="ND_x">
      <dot name="d" type="color3"><input name="in" type="color3" interfacename="in"/></dot>
      <output name="out" type="color3" nodename="d"/>
    </nodegraph>
    <x name="n" type="color3"/>
    <output name="out" type="color3" nodename="n"/>)",
                                   {"out"}, native_transforms());
  EXPECT_NE(text.find("ND_acescg_to_lin_rec709_color3(in=[1, 0, 0])"), std::string::npos) << text;
}

TEST(Colour, AliasesAndNoSpace) {
  EXPECT_EQ(canonical_colorspace("gamma22"), "g22_rec709");
  EXPECT_EQ(canonical_colorspace("lin_ap1"), "acescg");
  EXPECT_EQ(canonical_colorspace("Utility - sRGB - Texture"), "srgb_texture");
  EXPECT_EQ(canonical_colorspace("Raw"), "");
  EXPECT_EQ(canonical_colorspace("my_space"), "my_space");
}

std::string unit_text(std::string_view type, std::string_view value, std::string_view unit,
                      const GraphOptions& options = {}) {
  const std::string body = "<constant name=\"c\" type=\"" + std::string(type) +
                           "\"><input name=\"value\" type=\"" + std::string(type) + "\" value=\"" +
                           std::string(value) + "\" unit=\"" + std::string(unit) +
                           "\" unittype=\"distance\" uniform=\"true\"/></constant>"
                           "<output name=\"out\" type=\"" +
                           std::string(type) + "\" nodename=\"c\"/>";
  return text_of(body, {"out"}, options);
}

TEST(Unit, LiteralsAreFolded) {
  EXPECT_EQ(unit_text("float", "250", "centimeter"),
            "%0 = ND_constant_float(value=2.5) : float\noutput \"out\" float = %0\n");
  GraphOptions options;
  options.distance_unit = "millimeter";
  EXPECT_EQ(unit_text("vector2", "1, 2", "inch", options),
            "%0 = ND_constant_vector2(value=[25.4, 50.8]) : vector2\n"
            "output \"out\" vector2 = %0\n");
  EXPECT_EQ(unit_text("float", "3", "meter"),
            "%0 = ND_constant_float(value=3) : float\noutput \"out\" float = %0\n");
}

TEST(Unit, LiveParametersAreMultiplied) {
  EXPECT_EQ(text_of(R"(<constant name="c" type="float">
                         <input name="value" type="float" value="5" unit="kilometer"/>
                       </constant>
                       <output name="out" type="float" nodename="c"/>)",
                    {"out"}),
            "parameter 0 float \"c/value\" = 5 kilometer\n"
            "%0 = ND_multiply_float(in1=$0, in2=1000) : float\n"
            "%1 = ND_constant_float(value=%0) : float\n"
            "output \"out\" float = %1\n");
}

TEST(Unit, NodeDefSaysWhichUnitItWants) {
  const std::string text = text_of(R"(<rotate2d name="r" type="vector2">
                         <input name="amount" type="float" value="1" unit="radian" uniform="true"/>
                       </rotate2d>
                       <output name="out" type="vector2" nodename="r"/>)",
                                   {"out"});
  // A radian is 57.2957795... degrees; the library rounds its size to 57.2958.
  EXPECT_NE(text.find("amount=57.2957"), std::string::npos) << text;
}

TEST(Unit, InterfaceIsConvertedOnceWhereItIsRead) {
  EXPECT_EQ(text_of(R"(<nodegraph name="NG">
                         <input name="size" type="float" value="2" unit="kilometer" uniform="true"/>
                         <constant name="c" type="float">
                           <input name="value" type="float" interfacename="size"/>
                         </constant>
                         <sin name="s" type="float">
                           <input name="in" type="float" nodename="c"/>
                         </sin>
                         <output name="out" type="float" nodename="s"/>
                       </nodegraph>)",
                    {"NG/out"}),
            "%0 = ND_constant_float(value=2000) : float\n"
            "%1 = ND_sin_float(in=%0) : float\n"
            "output \"NG/out\" float = %1\n");
}

TEST(Unit, FilesScaleWhatIsRead) {
  const std::string text = text_of(R"(
    <image name="i" type="vector3">
      <input name="file" type="filename" value="d.exr" unit="millimeter" unittype="distance"/>
    </image>
    <output name="out" type="vector3" nodename="i"/>)",
                                   {"out"});
  EXPECT_NE(text.find("%2 = ND_multiply_vector3FA(in1=%1, in2=0.001) : vector3"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace nacre
