// The step from 1.38 to 1.39, as upgrade_test.cpp.
#include "tests/jit/document/upgraded.h"

namespace nacre {
namespace {

TEST(UpgradeTo139, Atan2TakesYFirst) {
  // 1.37 had in1 = x and in2 = y; 1.38 the other way round.
  EXPECT_EQ(upgraded("1.38", R"(
    <atan2 name="a" type="float">
      <input name="in1" type="float" value="1"/><input name="in2" type="float" value="2"/>
    </atan2>)"),
            current(R"(
    <atan2 name="a" type="float">
      <input name="iny" type="float" value="1"/><input name="inx" type="float" value="2"/>
    </atan2>)"));
  EXPECT_EQ(upgraded("1.37", R"(
    <atan2 name="a" type="float">
      <input name="in1" type="float" value="1"/><input name="in2" type="float" value="2"/>
    </atan2>
    <atan2 name="b" type="float"><input name="in2" type="float" value="2"/></atan2>)"),
            current(R"(
    <atan2 name="a" type="float">
      <input name="inx" type="float" value="1"/><input name="iny" type="float" value="2"/>
    </atan2>
    <atan2 name="b" type="float"><input name="iny" type="float" value="2"/></atan2>)"));
}

TEST(UpgradeTo139, ConnectionsWinOverValues) {
  EXPECT_EQ(upgraded("1.38", R"(
    <constant name="c" type="float"/>
    <absval name="a" type="float"><input name="in" type="float" value="1" nodename="c"/></absval>)"),
            current(R"(
    <constant name="c" type="float"/>
    <absval name="a" type="float"><input name="in" type="float" nodename="c"/></absval>)"));
}

TEST(UpgradeTo139, SwitchOutsideOfFiveIsTheFirst) {
  const auto with = [](std::string_view which) {
    return R"(<switch name="s" type="float"><input name="which" type="float" value=")" +
           std::string(which) + "\"/></switch>";
  };
  EXPECT_EQ(upgraded("1.38", with("4")), current(with("4")));
  EXPECT_EQ(upgraded("1.38", with("4.5")), current(with("4.5")));
  EXPECT_EQ(upgraded("1.38", with("5")), current(with("0")));
  EXPECT_EQ(upgraded("1.38", with("7.5")), current(with("0")));
}

TEST(UpgradeTo139, RadiusIsAColour) {
  EXPECT_EQ(upgraded("1.38", R"(
    <subsurface_bsdf name="s" type="BSDF"><input name="radius" type="vector3" value="1,2,3"/></subsurface_bsdf>)"),
            current(R"(
    <convert name="convert" type="color3"><input name="in" type="vector3" value="1,2,3"/></convert>
    <subsurface_bsdf name="s" type="BSDF"><input name="radius" type="color3" nodename="convert"/></subsurface_bsdf>)"));
}

// What a swizzle of these inputs becomes.
std::string swizzle(std::string_view type, std::string_view in, std::string_view channels,
                    std::string_view more = "") {
  return upgraded("1.38", "<swizzle name=\"s\" type=\"" + std::string(type) + "\" " +
                              std::string(more) + "><input name=\"in\" " + std::string(in) +
                              "/><input name=\"channels\" type=\"string\" value=\"" +
                              std::string(channels) + "\"/></swizzle>");
}

TEST(UpgradeSwizzle, OfAValueIsAConstant) {
  EXPECT_EQ(swizzle("color3", R"(type="color3" value="0.4, 0.5, 0.6")", "bg1",
                    R"(nodedef="ND_swizzle_color3_color3")"),
            current(R"(<constant name="s" type="color3" nodedef="ND_constant_color3">
                         <input name="value" type="color3" value="0.6, 0.5, 1"/></constant>)"));
  EXPECT_EQ(swizzle("vector2", R"(type="vector4" value="1 2 3 4")", "wx"),
            current(R"(<constant name="s" type="vector2">
                         <input name="value" type="vector2" value="4, 1"/></constant>)"));
  EXPECT_EQ(swizzle("color3", R"(type="float" nodename="x")", "010"),
            current(R"(<constant name="s" type="color3">
                         <input name="value" type="color3" value="0, 1, 0"/></constant>)"));
}

TEST(UpgradeSwizzle, OfAColourThatIsTransformedIsNotFolded) {
  // Channels change places after the transform, which mixes them.
  EXPECT_EQ(swizzle("float", R"(type="color3" value="1, 2, 3" colorspace="acescg")", "b"),
            current(R"(<extract name="s" type="float">
                         <input name="in" type="color3" value="1, 2, 3" colorspace="acescg"/>
                         <input name="index" type="integer" value="2"/></extract>)"));
}

TEST(UpgradeSwizzle, ToOneChannelExtracts) {
  EXPECT_EQ(swizzle("float", R"(type="vector4" nodename="x")", "w",
                    R"(nodedef="ND_swizzle_vector4_float")"),
            current(R"(<extract name="s" type="float" nodedef="ND_extract_vector4">
                         <input name="in" type="vector4" nodename="x"/>
                         <input name="index" type="integer" value="3"/></extract>)"));
  EXPECT_EQ(
      swizzle("float", R"(type="float" nodename="x")", "x"),
      current(R"(<dot name="s" type="float"><input name="in" type="float" nodename="x"/></dot>)"));
}

TEST(UpgradeSwizzle, InOrderConverts) {
  EXPECT_EQ(
      swizzle("color3", R"(type="float" nodename="x")", "rrr"),
      current(
          R"(<convert name="s" type="color3"><input name="in" type="float" nodename="x"/></convert>)"));
  EXPECT_EQ(swizzle("vector3", R"(type="color4" nodename="x")", "rgb",
                    R"(nodedef="ND_swizzle_color4_vector3")"),
            current(R"(<convert name="s" type="vector3" nodedef="ND_convert_color4_vector3">
                         <input name="in" type="color4" nodename="x"/></convert>)"));
}

TEST(UpgradeSwizzle, OfAFloatCombines) {
  EXPECT_EQ(swizzle("color4", R"(type="float" nodename="x")", "rr01"),
            current(R"(<combine4 name="s" type="color4">
                         <input name="in1" type="float" nodename="x"/><input name="in2" type="float" nodename="x"/>
                         <input name="in3" type="float" value="0"/><input name="in4" type="float" value="1"/>
                       </combine4>)"));
}

TEST(UpgradeSwizzle, OtherwiseSeparatesAndCombines) {
  EXPECT_EQ(swizzle("color3", R"(type="color3" nodename="x")", "bgr"),
            current(R"(<separate3 name="separate" type="multioutput">
                         <input name="in" type="color3" nodename="x"/></separate3>
                       <combine3 name="s" type="color3">
                         <input name="in1" type="float" nodename="separate" output="outb"/>
                         <input name="in2" type="float" nodename="separate" output="outg"/>
                         <input name="in3" type="float" nodename="separate" output="outr"/></combine3>)"));
  // Outputs are called as the source's channels, whatever letters are used.
  EXPECT_EQ(swizzle("vector2", R"(type="color3" nodename="x")", "z0"),
            current(R"(<separate3 name="separate" type="multioutput">
                         <input name="in" type="color3" nodename="x"/></separate3>
                       <combine2 name="s" type="vector2">
                         <input name="in1" type="float" nodename="separate" output="outb"/>
                         <input name="in2" type="float" value="0"/></combine2>)"));
}

TEST(UpgradeChannels, AskTheSourceForItsType) {
  EXPECT_EQ(upgraded("1.38", R"(
    <constant name="c" type="vector3"/>
    <absval name="a" type="float"><input name="in" type="float" nodename="c" channels="y"/></absval>
    <constant name="f" type="float"/>
    <absval name="b" type="float"><input name="in" type="float" nodename="f" channels="x"/></absval>)"),
            current(R"(
    <constant name="c" type="vector3"/>
    <extract name="swizzle" type="float">
      <input name="in" type="vector3" nodename="c"/><input name="index" type="integer" value="1"/>
    </extract>
    <absval name="a" type="float"><input name="in" type="float" nodename="swizzle"/></absval>
    <constant name="f" type="float"/>
    <absval name="b" type="float"><input name="in" type="float" nodename="f"/></absval>)"));
}

TEST(UpgradeChannels, OfGraphsAndInterfaces) {
  EXPECT_EQ(upgraded("1.38", R"(
    <nodegraph name="NG">
      <input name="tint" type="color4" value="1,2,3,4"/>
      <absval name="a" type="float"><input name="in" type="float" interfacename="tint" channels="a"/></absval>
      <constant name="k" type="color3"/>
      <output name="out" type="color3" nodename="k"/>
    </nodegraph>
    <absval name="b" type="float"><input name="in" type="float" nodegraph="NG" output="out" channels="b"/></absval>)"),
            current(R"(
    <nodegraph name="NG">
      <input name="tint" type="color4" value="1,2,3,4"/>
      <extract name="swizzle" type="float">
        <input name="in" type="color4" interfacename="tint"/><input name="index" type="integer" value="3"/>
      </extract>
      <absval name="a" type="float"><input name="in" type="float" nodename="swizzle"/></absval>
      <constant name="k" type="color3"/>
      <output name="out" type="color3" nodename="k"/>
    </nodegraph>
    <extract name="swizzle" type="float">
      <input name="in" type="color3" nodegraph="NG" output="out"/><input name="index" type="integer" value="2"/>
    </extract>
    <absval name="b" type="float"><input name="in" type="float" nodename="swizzle"/></absval>)"));
}

TEST(UpgradeThinFilm, GoesIntoTheClosuresBelow) {
  EXPECT_EQ(upgraded("1.38", R"(
    <thin_film_bsdf name="film" type="BSDF"><input name="ior" type="float" nodename="n"/></thin_film_bsdf>
    <dielectric_bsdf name="glass" type="BSDF">
      <input name="scatter_mode" type="string" value="T"/>
    </dielectric_bsdf>
    <conductor_bsdf name="metal" type="BSDF"/>
    <mix name="m" type="BSDF">
      <input name="fg" type="BSDF" nodename="glass"/><input name="bg" type="BSDF" nodename="metal"/>
    </mix>
    <layer name="l" type="BSDF">
      <input name="top" type="BSDF" nodename="film"/><input name="base" type="BSDF" nodename="m"/>
    </layer>
    <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="l"/></surface>)"),
            current(R"(
    <dielectric_bsdf name="glass" type="BSDF">
      <input name="scatter_mode" type="string" value="T"/>
    </dielectric_bsdf>
    <conductor_bsdf name="metal" type="BSDF">
      <input name="thinfilm_thickness" type="float" value="550"/>
      <input name="thinfilm_ior" type="float" nodename="n"/>
    </conductor_bsdf>
    <mix name="m" type="BSDF">
      <input name="fg" type="BSDF" nodename="glass"/><input name="bg" type="BSDF" nodename="metal"/>
    </mix>
    <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="m"/></surface>)"));
}

TEST(UpgradeThinFilm, OfTwoFilmsTheOuterOneStays) {
  EXPECT_EQ(upgraded("1.38", R"(
    <thin_film_bsdf name="f1" type="BSDF"><input name="thickness" type="float" value="100"/></thin_film_bsdf>
    <thin_film_bsdf name="f2" type="BSDF"><input name="thickness" type="float" value="200"/></thin_film_bsdf>
    <dielectric_bsdf name="d" type="BSDF"/>
    <layer name="l1" type="BSDF">
      <input name="top" type="BSDF" nodename="f1"/><input name="base" type="BSDF" nodename="d"/>
    </layer>
    <layer name="l2" type="BSDF">
      <input name="top" type="BSDF" nodename="f2"/><input name="base" type="BSDF" nodename="l1"/>
    </layer>
    <output name="out" type="BSDF" nodename="l2"/>)"),
            current(R"(
    <dielectric_bsdf name="d" type="BSDF">
      <input name="thinfilm_thickness" type="float" value="200"/>
      <input name="thinfilm_ior" type="float" value="1.5"/>
    </dielectric_bsdf>
    <output name="out" type="BSDF" nodename="d"/>)"));
}

TEST(UpgradeNormalmap, InObjectSpaceIsDecoded) {
  EXPECT_EQ(upgraded("1.38", R"(
    <normalmap name="n" type="vector3" nodedef="ND_normalmap">
      <input name="in" type="vector3" nodename="i"/><input name="space" type="string" value="object"/>
    </normalmap>)"),
            current(R"(
    <multiply name="multiply" type="vector3">
      <input name="in1" type="vector3" nodename="i"/><input name="in2" type="float" value="2"/>
    </multiply>
    <subtract name="subtract" type="vector3">
      <input name="in1" type="vector3" nodename="multiply"/><input name="in2" type="float" value="1"/>
    </subtract>
    <normalize name="n" type="vector3" nodedef="ND_normalize_vector3">
      <input name="in" type="vector3" nodename="subtract"/>
    </normalize>)"));
}

TEST(UpgradeNormalmap, AGivenFrameGetsItsBitangent) {
  EXPECT_EQ(upgraded("1.38", R"(
    <normalmap name="n" type="vector3" nodedef="ND_normalmap">
      <input name="space" type="string" value="tangent"/><input name="tangent" type="vector3" nodename="t"/>
    </normalmap>
    <normalmap name="m" type="vector3"/>)"),
            current(R"(
    <normal name="normalmap_normal" type="vector3"><input name="space" type="string" value="world"/></normal>
    <crossproduct name="normalmap_cross" type="vector3">
      <input name="in1" type="vector3" nodename="normalmap_normal"/><input name="in2" type="vector3" nodename="t"/>
    </crossproduct>
    <normalize name="normalmap_cross_norm" type="vector3"><input name="in" type="vector3" nodename="normalmap_cross"/></normalize>
    <normalmap name="n" type="vector3" nodedef="ND_normalmap_float">
      <input name="tangent" type="vector3" nodename="t"/>
      <input name="bitangent" type="vector3" nodename="normalmap_cross_norm"/>
    </normalmap>
    <normalmap name="m" type="vector3"/>)"));
}

}  // namespace
}  // namespace nacre
