// Each rule of "upgradeVersion" of the reference (MaterialXCore/Version.cpp, 1.39)
// and of the change lists of the specifications: what an author wrote, and what it
// has to be in 1.39.
#include <gtest/gtest.h>

#include "tests/jit/document/upgraded.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

TEST(UpgradeTo123, VectorIsVector3) {
  EXPECT_EQ(upgraded("1.22", R"(<position name="p" type="vector"/>)"),
            current(R"(<position name="p" type="vector3"/>)"));
}

TEST(UpgradeTo134, GraphsFeedTheShaderOfTheirMaterial) {
  EXPECT_EQ(upgraded("1.22", R"(
    <opgraph name="og">
      <constant name="c" type="float"><parameter name="color" type="float" value="0.5"/></constant>
      <absval name="a" type="float"><parameter name="in" type="opgraphnode" value="c"/></absval>
      <output name="o" type="float"><parameter name="in" type="opgraphnode" value="a"/></output>
    </opgraph>
    <shader name="s" shadertype="surface" shadername="standard_surface">
      <input name="base" graphoutput="o" graphname="og" type="float"/>
    </shader>
    <material name="m"><shaderref name="s" shadertype="surface"/></material>
    <look name="l"><assign name="m" geom="/a"/></look>)"),
            current(R"(
    <nodegraph name="og">
      <constant name="c" type="float"><input name="value" type="float" value="0.5"/></constant>
      <absval name="a" type="float"><input name="in" type="float" nodename="c"/></absval>
      <output name="o" type="float" nodename="a"/>
    </nodegraph>
    <standard_surface name="s" type="surfaceshader">
      <input name="base" type="float" nodegraph="og" output="o"/>
    </standard_surface>
    <surfacematerial name="m" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="s"/>
    </surfacematerial>
    <look name="l"><materialassign name="m" material="m" geom="/a"/></look>)"));
}

TEST(UpgradeTo134, TilesOfGeometriesBecomeOneSet) {
  EXPECT_EQ(upgraded("1.26", R"(
    <geominfo name="g1"><geomattr name="udim" type="string" value="1002"/></geominfo>
    <geominfo name="g2"><geomattr name="udim" type="string" value="1001"/></geominfo>)"),
            current(R"(
    <geominfo name="g1"><geomprop name="udim" type="string" value="1002"/></geominfo>
    <geominfo name="g2"><geomprop name="udim" type="string" value="1001"/></geominfo>
    <geominfo name="geominfo1">
      <geomprop name="udimset" type="stringarray" value="1001, 1002"/>
    </geominfo>)"));
}

TEST(UpgradeTo135, MatrixAndDefault) {
  EXPECT_EQ(upgraded("1.34", R"(
    <geominfo name="g"><geomprop name="p" type="matrix" default="1"/></geominfo>
    <look name="l"><materialassign name="m" geom="/a"/></look>)"),
            current(R"(
    <geominfo name="g"><geomprop name="p" type="matrix44" value="1"/></geominfo>
    <look name="l"><materialassign name="m" material="m" geom="/a"/></look>)"));
}

TEST(UpgradeTo136, TokensOverridesAndInheritance) {
  EXPECT_EQ(upgraded("1.35", R"(
    <nodedef name="s" node="standard_surface" shadertype="surface" type="surfaceshader">
      <input name="base" type="float" value="1" publicname="how_much"/>
      <input name="coat" type="float" value="1" publicname="varnish"/>
    </nodedef>
    <material name="m">
      <shaderref name="r" nodedef="s"><bindinput name="coat" type="float" value="0.1"/></shaderref>
      <override name="how_much" type="float" value="0.5"/>
      <override name="varnish" type="float" value="0.7"/>
    </material>
    <image name="i" type="color3">
      <parameter name="file" type="filename" value="a%UDIM_%UVTILE.png"/>
    </image>
    <look name="l"/><look name="k"><lookinherit name="li" look="l"/></look>
    <collection name="c"><parameter name="g" type="geomname" value="*"/></collection>)"),
            current(R"(
    <standard_surface name="r" type="surfaceshader">
      <input name="coat" type="float" value="0.1"/>
      <input name="base" type="float" value="0.5"/>
    </standard_surface>
    <surfacematerial name="m" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="r"/>
    </surfacematerial>
    <image name="i" type="color3">
      <input name="file" type="filename" value="a<UDIM>_<UVTILE>.png"/>
    </image>
    <look name="l"/><look name="k" inherit="l"/>
    <collection name="c"><input name="g" type="geomname" value="/"/></collection>)"));
}

TEST(UpgradeTo137, TypeOfANodedefIsItsOutput) {
  EXPECT_EQ(upgraded("1.36", R"(
    <nodedef name="ND_x" node="x" type="color3" defaultinput="in">
      <input name="in" type="color3" value="1,1,1"/><parameter name="p" type="float" value="2"/>
    </nodedef>)"),
            current(R"(
    <nodedef name="ND_x" node="x">
      <input name="in" type="color3" value="1,1,1"/>
      <input name="p" type="float" value="2" uniform="true"/>
      <output name="out" type="color3" defaultinput="in"/>
    </nodedef>)"));
}

TEST(UpgradeTo137, NodesGetTheirNames) {
  EXPECT_EQ(upgraded("1.36", R"(
    <invert name="i" type="float"/><invert name="m" type="matrix33"/>
    <rotate name="r2" type="vector2"/><rotate name="r3" type="vector3"/>
    <transformpoint name="t1" type="vector3"><input name="mat" type="matrix33"/></transformpoint>
    <transformpoint name="t2" type="vector3">
      <parameter name="fromspace" type="string" value="object"/>
    </transformpoint>
    <combine name="c" type="color3"><input name="in3" type="float" value="1"/></combine>
    <separate name="s" type="multioutput"><input name="in" type="color4" value="1,2,3,4"/></separate>
    <geomattrvalue name="g" type="integer" attrname="id"/>
    <backdrop name="b"><parameter name="width" type="float" value="20"/></backdrop>)"),
            current(R"(
    <invert name="i" type="float"/><invertmatrix name="m" type="matrix33"/>
    <rotate2d name="r2" type="vector2"/><rotate3d name="r3" type="vector3"/>
    <transformmatrix name="t1" type="vector3"><input name="mat" type="matrix33"/></transformmatrix>
    <transformpoint name="t2" type="vector3">
      <input name="fromspace" type="string" value="object"/>
    </transformpoint>
    <combine3 name="c" type="color3"><input name="in3" type="float" value="1"/></combine3>
    <separate4 name="s" type="multioutput"><input name="in" type="color4" value="1,2,3,4"/></separate4>
    <geompropvalue name="g" type="integer">
      <input name="geomprop" type="string" value="id"/>
    </geompropvalue>
    <backdrop name="b" width="20"/>)"));
}

TEST(UpgradeTo137, CompareChangesItsBranches) {
  EXPECT_EQ(upgraded("1.36", R"(
    <compare name="c" type="float">
      <input name="intest" type="float" value="0.5"/><parameter name="cutoff" type="float" value="0.6"/>
      <input name="in1" type="float" value="1"/><input name="in2" type="float" value="2"/>
    </compare>
    <compare name="d" type="float"><input name="in1" type="float" value="1"/></compare>)"),
            current(R"(
    <ifgreatereq name="c" type="float">
      <input name="value1" type="float" value="0.5"/><input name="value2" type="float" value="0.6"/>
      <input name="in2" type="float" value="1"/><input name="in1" type="float" value="2"/>
    </ifgreatereq>
    <ifgreatereq name="d" type="float"><input name="in2" type="float" value="1"/></ifgreatereq>)"));
}

TEST(UpgradeTo138, Color2IsVector2) {
  EXPECT_EQ(upgraded("1.37", R"(
    <constant name="c" type="color2"><parameter name="value" type="color2" value="1,2"/></constant>
    <separate2 name="s" type="multioutput"><input name="in" type="color2" nodename="c"/></separate2>
    <absval name="a" type="float"><input name="in" type="float" nodename="s" output="outa"/></absval>
    <absval name="b" type="float" nodedef="ND_absval_color2"/>
    <output name="alpha" type="float" nodename="c" channels="a"/>)"),
            current(R"(
    <constant name="c" type="vector2"><input name="value" type="vector2" value="1,2"/></constant>
    <separate2 name="s" type="multioutput"><input name="in" type="vector2" nodename="c"/></separate2>
    <absval name="a" type="float"><input name="in" type="float" nodename="s" output="outy"/></absval>
    <absval name="b" type="float" nodedef="ND_absval_vector2"/>
    <extract name="swizzle" type="float">
      <input name="in" type="vector2" nodename="c"/><input name="index" type="integer" value="1"/>
    </extract>
    <output name="alpha" type="float" nodename="swizzle"/>)"));
}

TEST(UpgradeTo138, MaterialsAreNodes) {
  EXPECT_EQ(upgraded("1.37", R"(
    <material name="M" xpos="3">
      <shaderref name="S" node="standard_surface" version="1.0.0">
        <bindinput name="base" type="float" value="1"/>
        <bindinput name="coat" type="float" nodegraph="NG" output="out"/>
        <bindparam name="thin_walled" type="boolean" value="true"/>
        <bindtoken name="t" type="string" value="x"/>
      </shaderref>
      <shaderref name="D" nodedef="ND_displacement_float" node="displacement"/>
    </material>
    <material name="N"><shaderref name="S" node="standard_surface"/></material>
    <material name="V"><shaderref name="S" node="volume"/></material>)"),
            current(R"(
    <standard_surface name="S" type="surfaceshader" version="1.0.0">
      <input name="base" type="float" value="1"/>
      <input name="coat" type="float" nodegraph="NG" output="out"/>
      <input name="thin_walled" type="boolean" value="true"/>
      <token name="t" type="string" value="x"/>
    </standard_surface>
    <displacement name="D" type="displacementshader" nodedef="ND_displacement_float"/>
    <surfacematerial name="M" type="material" xpos="3">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/>
      <input name="displacementshader" type="displacementshader" nodename="D"/>
    </surfacematerial>
    <standard_surface name="S2" type="surfaceshader"/>
    <surfacematerial name="N" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S2"/>
    </surfacematerial>
    <volume name="S3" type="volumeshader"/>
    <volumematerial name="V" type="material">
      <input name="volumeshader" type="volumeshader" nodename="S3"/>
    </volumematerial>)"));
}

TEST(UpgradeTo138, ClosuresAreRenamed) {
  EXPECT_EQ(upgraded("1.37", R"(
    <diffuse_brdf name="a" type="BSDF" nodedef="ND_diffuse_brdf"/>
    <burley_diffuse_brdf name="b" type="BSDF"/><diffuse_btdf name="c" type="BSDF"/>
    <subsurface_brdf name="d" type="BSDF"/><sheen_brdf name="e" type="BSDF"/>
    <dielectric_btdf name="f" type="BSDF">
      <input name="ior" type="float" value="1.3"/><input name="interior" type="VDF" value=""/>
    </dielectric_btdf>)"),
            current(R"(
    <oren_nayar_diffuse_bsdf name="a" type="BSDF" nodedef="ND_oren_nayar_diffuse_bsdf"/>
    <burley_diffuse_bsdf name="b" type="BSDF"/><translucent_bsdf name="c" type="BSDF"/>
    <subsurface_bsdf name="d" type="BSDF"/><sheen_bsdf name="e" type="BSDF"/>
    <dielectric_bsdf name="f" type="BSDF">
      <input name="ior" type="float" value="1.3"/>
      <input name="scatter_mode" type="string" value="T"/>
    </dielectric_bsdf>)"));
}

TEST(UpgradeTo138, NestedClosuresAreLayers) {
  // The reader of `coat` reads the layer now; `coat` itself is its top.
  EXPECT_EQ(upgraded("1.37", R"(
    <diffuse_brdf name="base" type="BSDF"/>
    <sheen_brdf name="cloth" type="BSDF"><input name="base" type="BSDF" nodename="base"/></sheen_brdf>
    <dielectric_brdf name="coat" type="BSDF">
      <input name="ior" type="float" value="1.4"/><input name="base" type="BSDF" nodename="cloth"/>
    </dielectric_brdf>
    <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="coat"/></surface>)"),
            current(R"(
    <oren_nayar_diffuse_bsdf name="base" type="BSDF"/>
    <sheen_bsdf name="cloth__layer_top" type="BSDF"/>
    <layer name="cloth" type="BSDF">
      <input name="top" type="BSDF" nodename="cloth__layer_top"/>
      <input name="base" type="BSDF" nodename="base"/>
    </layer>
    <dielectric_bsdf name="coat__layer_top" type="BSDF">
      <input name="ior" type="float" value="1.4"/>
    </dielectric_bsdf>
    <layer name="coat" type="BSDF">
      <input name="top" type="BSDF" nodename="coat__layer_top"/>
      <input name="base" type="BSDF" nodename="cloth"/>
    </layer>
    <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="coat"/></surface>)"));
}

TEST(UpgradeTo138, ConductorsTakeIndices) {
  EXPECT_EQ(upgraded("1.37", R"(
    <conductor_brdf name="c" type="BSDF">
      <input name="weight" type="float" value="1"/>
      <input name="reflectivity" type="color3" value="0.9,0.8,0.7"/>
      <input name="edge_color" type="color3" interfacename="edge"/>
    </conductor_brdf>)"),
            current(R"(
    <artistic_ior name="c__artistic_ior" type="multioutput">
      <input name="reflectivity" type="color3" value="0.9,0.8,0.7"/>
      <input name="edge_color" type="color3" interfacename="edge"/>
    </artistic_ior>
    <conductor_bsdf name="c" type="BSDF">
      <input name="weight" type="float" value="1"/>
      <input name="ior" type="color3" nodename="c__artistic_ior" output="ior"/>
      <input name="extinction" type="color3" nodename="c__artistic_ior" output="extinction"/>
    </conductor_bsdf>)"));
}

TEST(UpgradeTo138, IndicesAreColoursAndConvertedForVectors) {
  EXPECT_EQ(upgraded("1.37", R"(
    <artistic_ior name="a" type="multioutput"/>
    <absval name="v" type="vector3"><input name="in" type="vector3" nodename="a" output="ior"/></absval>)"),
            current(R"(
    <artistic_ior name="a" type="multioutput"/>
    <convert name="v__convert_ior" type="vector3">
      <input name="in" type="color3" nodename="a" output="ior"/>
    </convert>
    <absval name="v" type="vector3"><input name="in" type="vector3" nodename="v__convert_ior"/></absval>)"));
}

TEST(UpgradeTo138, NodesAreNotCalledAsInputs) {
  EXPECT_EQ(upgraded("1.37", R"(
    <nodegraph name="NG" nodedef="ND_x" version="1.37">
      <absval name="color" type="color3"><input name="in" type="color3" interfacename="color"/></absval>
      <constant name="color2" type="color3"/>
      <output name="out" type="color3" nodename="color"/>
    </nodegraph>)"),
            current(R"(
    <nodegraph name="NG" nodedef="ND_x">
      <absval name="color3" type="color3"><input name="in" type="color3" interfacename="color"/></absval>
      <constant name="color2" type="color3"/>
      <output name="out" type="color3" nodename="color3"/>
    </nodegraph>)"));
}

TEST(Upgrade, NodesOfTheFileItselfStay) {
  const std::string_view body = R"(
    <nodedef name="ND_my_swizzle" node="swizzle"><output name="out" type="float"/></nodedef>
    <swizzle name="s" type="float" nodedef="ND_my_swizzle"/>)";
  EXPECT_EQ(upgraded("1.38", body), current(body));
}

TEST(Upgrade, ReplacementsStandWhereTheReplacedWasWritten) {
  Diagnostics diagnostics;
  const auto document = read_version("1.37",
                                     "<material name=\"M\">\n"                               // 2
                                     "  <shaderref name=\"S\" node=\"standard_surface\">\n"  // 3
                                     "    <bindinput name=\"base\" type=\"float\" value=\"1\"/>\n"
                                     "  </shaderref>\n"
                                     "</material>\n"
                                     "<swizzle name=\"z\" type=\"color3\">\n"                   // 7
                                     "  <input name=\"in\" type=\"color3\" nodename=\"x\"/>\n"  // 8
                                     "  <input name=\"channels\" type=\"string\" value=\"bgr\"/>\n"
                                     "</swizzle>\n",
                                     diagnostics);
  ASSERT_NE(document, nullptr) << diagnostics.to_string();
  const auto line = [&](std::string_view path, std::string_view port = "") {
    const Element* element = document->root().child(path);
    if (!port.empty()) element = element->child(port);
    return document->line_of(*element);
  };
  EXPECT_EQ(line("M"), 2);
  EXPECT_EQ(line("M", "surfaceshader"), 3);
  EXPECT_EQ(line("S"), 3);
  EXPECT_EQ(line("S", "base"), 4);
  EXPECT_EQ(line("separate"), 7);
  EXPECT_EQ(line("separate", "in"), 8);
  EXPECT_EQ(line("z", "in1"), 8);
}

// Everything that a step looks at, cut off and changed byte by byte.
TEST(Upgrade, WhatMakesNoSenseDoesNotCrashIt) {
  const std::string text =
      "<materialx version=\"1.22\"><opgraph name=\"g\"><swizzle name=\"s\" type=\"color3\">"
      "<input name=\"in\" type=\"color2\" nodename=\"a\" channels=\"ra\"/></swizzle>"
      "<thin_film_brdf name=\"f\"><input name=\"base\" nodename=\"l\"/></thin_film_brdf>"
      "<layer name=\"l\"><input name=\"top\" nodename=\"f\"/><input name=\"base\" "
      "nodename=\"l\"/></layer><normalmap name=\"in\"><input name=\"normal\" "
      "interfacename=\"in\"/></normalmap><compare name=\"c\"/><separate name=\"p\"/>"
      "<backdrop name=\"b\"/><output name=\"o\"><parameter name=\"in\" type=\"opgraphnode\" "
      "value=\"s\"/></output></opgraph><shader name=\"h\" shadertype=\"s\"><input name=\"i\" "
      "graphname=\"g\" graphoutput=\"o\" publicname=\"q\"/></shader><material name=\"m\">"
      "<shaderref name=\"h\"/><override name=\"q\"/></material></materialx>";
  const auto try_text = [](const std::string& changed) {
    Diagnostics diagnostics;
    ReadOptions options;
    options.keep_comments = true;
    const auto document = read_document_text(changed, "changed", options, diagnostics);
    EXPECT_EQ(document == nullptr, diagnostics.has_errors());
  };
  for (std::size_t at = 0; at < text.size(); ++at) {
    try_text(text.substr(0, at));
    for (const char byte : {'"', '<', '>', ' ', 'a', '2', '\0'}) {
      std::string changed = text;
      changed[at] = byte;
      try_text(changed);
    }
  }
}

// n films in a chain over n closures are n^2 / 2 visits.
TEST(Upgrade, TakesBoundedTime) {
  constexpr int films = 20'000;
  std::string body = "<thin_film_bsdf name=\"f\" type=\"BSDF\"/><conductor_bsdf name=\"l0\"/>";
  for (int i = 1; i <= films; ++i) {
    const std::string n = std::to_string(i);
    const std::string below = std::to_string(i - 1);
    body += "<mix name=\"m" + n + "\"><input name=\"fg\" nodename=\"l" + below +
            "\"/></mix><layer name=\"l" + n + "\"><input name=\"top\" nodename=\"f\"/>" +
            "<input name=\"base\" nodename=\"m" + n + "\"/></layer>";
  }
  Diagnostics diagnostics;
  EXPECT_EQ(read_version("1.38", body, diagnostics), nullptr);
  EXPECT_EQ(diagnostics.all().front().code, "cannot-upgrade");
}

TEST(Upgrade, EachIncludedFileByItsOwnVersion) {
  const TemporaryFolder folder;
  const auto atan2 = [](std::string_view name) {
    return "<atan2 name=\"" + std::string(name) +
           "\" type=\"float\"><input name=\"in1\" type=\"float\" value=\"1\"/></atan2>";
  };
  folder.write("a.mtlx", "<materialx version=\"1.37\">" + atan2("a") + "</materialx>");
  const std::string file =
      folder.write("b.mtlx", "<materialx version=\"1.38\"><xi:include href=\"a.mtlx\"/>" +
                                 atan2("b") + "</materialx>");
  Diagnostics diagnostics;
  const auto document = read_document(file, {}, diagnostics);
  ASSERT_NE(document, nullptr) << diagnostics.to_string();
  EXPECT_NE(document->root().child("a")->child("inx"), nullptr);
  EXPECT_NE(document->root().child("b")->child("iny"), nullptr);
}

}  // namespace
}  // namespace nacre
