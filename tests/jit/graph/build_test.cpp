#include "jit/graph/build/build.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/jit/graph/build_text.h"

namespace nacre {
namespace {

bool nothing_is_native(std::string_view) { return false; }

TEST(BuildGraph, FillsInDefaultsInNodeDefOrder) {
  EXPECT_EQ(text_of(R"(<mix name="m" type="float">
                         <input name="mix" type="float" value="0.25"/>
                         <input name="fg" type="float" value="2"/>
                       </mix>
                       <output name="out" type="float" nodename="m"/>)",
                    {"out"}),
            "parameter 0 float \"m/fg\" = 2\n"
            "parameter 1 float \"m/mix\" = 0.25\n"
            "%0 = ND_mix_float(fg=$0, bg=0, mix=$1) : float\n"
            "output \"out\" float = %0\n");
}

TEST(BuildGraph, GeometricDefaultsAreSharedNodes) {
  EXPECT_EQ(text_of(R"(<noise2d name="a" type="float"/>
                       <noise2d name="b" type="float"/>
                       <add name="s" type="float">
                         <input name="in1" type="float" nodename="a"/>
                         <input name="in2" type="float" nodename="b"/>
                       </add>
                       <output name="out" type="float" nodename="s"/>)",
                    {"out"}),
            "%0 = ND_texcoord_vector2(index=0) : vector2\n"
            "%1 = ND_noise2d_float(amplitude=1, pivot=0, texcoord=%0) : float\n"
            "%2 = ND_noise2d_float(amplitude=1, pivot=0, texcoord=%0) : float\n"
            "%3 = ND_add_float(in1=%1, in2=%2) : float\n"
            "output \"out\" float = %3\n");
}

TEST(BuildGraph, GeometricDefaultsKeepTheirSpace) {
  const std::string text = text_of(R"(<dielectric_bsdf name="d" type="BSDF"/>
                                      <output name="out" type="BSDF" nodename="d"/>)",
                                   {"out"});
  EXPECT_NE(text.find("ND_normal_vector3(space=\"world\")"), std::string::npos) << text;
  EXPECT_NE(text.find("ND_tangent_vector3(space=\"world\", index=0)"), std::string::npos) << text;
}

TEST(BuildGraph, CustomGeompropBecomesGeompropvalue) {
  EXPECT_EQ(text_of(R"(<geompropdef name="Fur" type="vector3" geomprop="fur_direction"/>
                       <nodegraph name="NG">
                         <input name="d" type="vector3" defaultgeomprop="Fur"/>
                         <normalize name="n" type="vector3">
                           <input name="in" type="vector3" interfacename="d"/>
                         </normalize>
                         <output name="out" type="vector3" nodename="n"/>
                       </nodegraph>)",
                    {"NG/out"}),
            "%0 = ND_geompropvalue_vector3(geomprop=\"fur_direction\", default=[0, 0, 0]) : "
            "vector3\n"
            "%1 = ND_normalize_vector3(in=%0) : vector3\n"
            "output \"NG/out\" vector3 = %1\n");
}

constexpr std::string_view doubled = R"(
  <nodedef name="ND_double" node="double">
    <input name="in" type="float" value="3"/>
    <output name="out" type="float"/>
  </nodedef>
  <nodegraph name="NG_double" nodedef="ND_double">
    <add name="sum" type="float">
      <input name="in1" type="float" interfacename="in"/>
      <input name="in2" type="float" interfacename="in"/>
    </add>
    <output name="out" type="float" nodename="sum"/>
  </nodegraph>
  <constant name="c" type="float"><input name="value" type="float" value="5"/></constant>
  <double name="a" type="float"><input name="in" type="float" nodename="c"/></double>
  <double name="b" type="float"><input name="in" type="float" nodename="a"/></double>
  <double name="d" type="float"/>
  <output name="out" type="float" nodename="b"/>
  <output name="plain" type="float" nodename="d"/>)";

TEST(BuildGraph, InlinesOncePerInstance) {
  EXPECT_EQ(text_of(doubled, {"out"}),
            "parameter 0 float \"c/value\" = 5\n"
            "%0 = ND_constant_float(value=$0) : float\n"
            "%1 = ND_add_float(in1=%0, in2=%0) : float\n"
            "%2 = ND_add_float(in1=%1, in2=%1) : float\n"
            "output \"out\" float = %2\n");
  const Graph graph = graph_of(doubled, {"out"});
  EXPECT_EQ(graph.nodes[1].path, "a/sum");
  EXPECT_EQ(graph.nodes[2].path, "b/sum");
}

TEST(BuildGraph, DefaultsOfNodeDefsAreLiterals) {
  EXPECT_EQ(text_of(doubled, {"plain"}),
            "%0 = ND_add_float(in1=3, in2=3) : float\n"
            "output \"plain\" float = %0\n");
}

TEST(BuildGraph, FunctionalGraphAloneTakesItsDefaults) {
  EXPECT_EQ(text_of(doubled, {"NG_double/out"}),
            "%0 = ND_add_float(in1=3, in2=3) : float\n"
            "output \"NG_double/out\" float = %0\n");
}

TEST(BuildGraph, NativeBodyIsPreferredToGraph) {
  GraphOptions options;
  options.is_native = [](std::string_view name) {
    return name == "ND_double" || name == "ND_constant_float";
  };
  EXPECT_EQ(text_of(doubled, {"out"}, options),
            "parameter 0 float \"c/value\" = 5\n"
            "%0 = ND_constant_float(value=$0) : float\n"
            "%1 = ND_double(in=%0) : float\n"
            "%2 = ND_double(in=%1) : float\n"
            "output \"out\" float = %2\n");
}

TEST(BuildGraph, WithoutImplementationTheDefaultPassesThrough) {
  Diagnostics diagnostics;
  const auto document = document_of(R"(
      <nodedef name="ND_warp" node="warp">
        <input name="amount" type="float" value="1"/>
        <input name="in" type="color3" value="0.1, 0.2, 0.3"/>
        <output name="out" type="color3" defaultinput="in" default="9, 9, 9"/>
      </nodedef>
      <nodedef name="ND_flat" node="flat">
        <output name="out" type="color3" default="7, 8, 9"/>
      </nodedef>
      <warp name="w" type="color3"/>
      <flat name="f" type="color3"/>
      <output name="w_out" type="color3" nodename="w"/>
      <output name="f_out" type="color3" nodename="f"/>)",
                                    diagnostics);
  GraphOptions options;
  options.is_native = nothing_is_native;
  const auto graph =
      build_graph(*document, standard_library(), {{"w_out", "f_out"}, ""}, options, diagnostics);
  ASSERT_TRUE(graph) << diagnostics.to_string();
  EXPECT_EQ(to_string(*graph),
            "output \"w_out\" color3 = [0.1, 0.2, 0.3]\n"
            "output \"f_out\" color3 = [7, 8, 9]\n");
  ASSERT_EQ(diagnostics.warning_count(), 2u);
  EXPECT_EQ(diagnostics.all()[0].code, "no-implementation");
  EXPECT_EQ(diagnostics.all()[0].where.path, "w");
}

TEST(BuildGraph, CompoundGraphsPassTheirInterface) {
  EXPECT_EQ(text_of(R"(<position name="p" type="vector3"/>
                       <nodegraph name="NG">
                         <input name="where" type="vector3" nodename="p"/>
                         <input name="size" type="float" value="2"/>
                         <multiply name="m" type="vector3">
                           <input name="in1" type="vector3" interfacename="where"/>
                           <input name="in2" type="float" interfacename="size"/>
                         </multiply>
                         <output name="a" type="vector3" nodename="m"/>
                         <output name="b" type="vector3" nodename="m"/>
                       </nodegraph>
                       <length name="unused" type="float"/>
                       <sin name="s" type="vector3">
                         <input name="in" type="vector3" nodegraph="NG" output="b"/>
                       </sin>
                       <output name="out" type="vector3" nodename="s"/>)",
                    {"out"}),
            "parameter 0 float \"NG/size\" = 2\n"
            "%0 = ND_position_vector3(space=\"object\") : vector3\n"
            "%1 = ND_multiply_vector3FA(in1=%0, in2=$0) : vector3\n"
            "%2 = ND_sin_vector3(in=%1) : vector3\n"
            "output \"out\" vector3 = %2\n");
}

TEST(BuildGraph, NestedGraphsLookOutwards) {
  EXPECT_EQ(text_of(R"(<nodegraph name="outer">
                         <input name="x" type="float" value="4"/>
                         <constant name="c" type="float">
                           <input name="value" type="float" interfacename="x"/>
                         </constant>
                         <nodegraph name="inner">
                           <input name="y" type="float" nodename="c"/>
                           <input name="z" type="float" interfacename="x"/>
                           <add name="s" type="float">
                             <input name="in1" type="float" interfacename="y"/>
                             <input name="in2" type="float" interfacename="z"/>
                           </add>
                           <output name="o" type="float" nodename="s"/>
                         </nodegraph>
                         <sin name="t" type="float">
                           <input name="in" type="float" nodegraph="inner" output="o"/>
                         </sin>
                         <output name="out" type="float" nodename="t"/>
                       </nodegraph>)",
                    {"outer/out", "outer/inner/o"}),
            "parameter 0 float \"outer/x\" = 4\n"
            "%0 = ND_constant_float(value=$0) : float\n"
            "%1 = ND_add_float(in1=%0, in2=$0) : float\n"
            "%2 = ND_sin_float(in=%1) : float\n"
            "output \"outer/out\" float = %2\n"
            "output \"outer/inner/o\" float = %1\n");
}

TEST(BuildGraph, RootIsAGraph) {
  EXPECT_EQ(text_of(R"(<input name="k" type="float" value="2"/>
                       <constant name="c" type="float">
                         <input name="value" type="float" interfacename="k"/>
                       </constant>
                       <output name="first" type="float" nodename="c"/>
                       <sin name="s" type="float">
                         <input name="in" type="float" output="first"/>
                       </sin>
                       <output name="second" type="float" nodename="s"/>)",
                    {"second"}),
            "parameter 0 float \"k\" = 2\n"
            "%0 = ND_constant_float(value=$0) : float\n"
            "%1 = ND_sin_float(in=%0) : float\n"
            "output \"second\" float = %1\n");
}

TEST(BuildGraph, OutputsOfOneNodeShareIt) {
  EXPECT_EQ(text_of(R"(<artistic_ior name="i" type="multioutput"/>
                       <add name="s" type="color3">
                         <input name="in1" type="color3" nodename="i" output="ior"/>
                         <input name="in2" type="color3" nodename="i" output="extinction"/>
                       </add>
                       <output name="out" type="color3" nodename="s"/>)",
                    {"out"}),
            "%0 = ND_artistic_ior(reflectivity=[0.944, 0.776, 0.373], "
            "edge_color=[0.998, 0.981, 0.751]) : color3 color3\n"
            "%1 = ND_add_color3(in1=%0.ior, in2=%0.extinction) : color3\n"
            "output \"out\" color3 = %1\n");
}

TEST(BuildGraph, UniformInputsGetLiterals) {
  EXPECT_EQ(text_of(R"(<nodegraph name="NG">
                         <input name="kc" type="boolean" value="true"/>
                         <constant name="c" type="boolean">
                           <input name="value" type="boolean" interfacename="kc"/>
                         </constant>
                         <dot name="d" type="boolean">
                           <input name="in" type="boolean" nodename="c"/>
                         </dot>
                         <oren_nayar_diffuse_bsdf name="b" type="BSDF">
                           <input name="weight" type="float" value="0.5"/>
                           <input name="energy_compensation" type="boolean" nodename="d"/>
                         </oren_nayar_diffuse_bsdf>
                         <output name="out" type="BSDF" nodename="b"/>
                       </nodegraph>)",
                    {"NG/out"}),
            "parameter 0 float \"NG/b/weight\" = 0.5\n"
            "%0 = ND_normal_vector3(space=\"world\") : vector3\n"
            "%1 = ND_oren_nayar_diffuse_bsdf(weight=$0, color=[0.18, 0.18, 0.18], roughness=0, "
            "normal=%0, energy_compensation=true) : BSDF\n"
            "output \"NG/out\" BSDF = %1\n");
}

TEST(BuildGraph, InstancesInheritInputs) {
  EXPECT_EQ(text_of(R"(<mix name="base" type="float">
                         <input name="fg" type="float" value="1"/>
                         <input name="bg" type="float" value="2"/>
                       </mix>
                       <mix name="m" type="float" inherit="base">
                         <input name="bg" type="float" value="3"/>
                       </mix>
                       <output name="out" type="float" nodename="m"/>)",
                    {"out"}),
            "parameter 0 float \"base/fg\" = 1\n"
            "parameter 1 float \"m/bg\" = 3\n"
            "%0 = ND_mix_float(fg=$0, bg=$1, mix=0) : float\n"
            "output \"out\" float = %0\n");
}

TEST(BuildGraph, WhatIsNotReachedIsNotLookedAt) {
  EXPECT_EQ(text_of(R"(<nonsense name="n" type="float"/>
                       <constant name="broken" type="float">
                         <input name="value" type="float" value="x"/>
                       </constant>
                       <constant name="c" type="float"/>
                       <output name="bad" type="float" nodename="broken"/>
                       <output name="out" type="float" nodename="c"/>)",
                    {"out"}),
            "%0 = ND_constant_float(value=0) : float\n"
            "output \"out\" float = %0\n");
}

TEST(BuildGraph, UnusedBranchesOfFunctionalGraphsAreGone) {
  const std::string text = text_of(R"(<separate3 name="s" type="multioutput">
                                        <input name="in" type="color3" value="1, 2, 3"/>
                                      </separate3>
                                      <output name="out" type="float" nodename="s" output="outg"/>)",
                                   {"out"});
  EXPECT_EQ(text,
            "parameter 0 color3 \"s/in\" = [1, 2, 3]\n"
            "%0 = ND_extract_color3(in=$0, index=1) : float\n"
            "output \"out\" float = %0\n");
}

TEST(BuildGraph, MaterialsBecomeTheirShaders) {
  Diagnostics diagnostics;
  const auto document = document_of(R"(
      <surface_unlit name="front" type="surfaceshader"/>
      <displacement name="bumpy" type="displacementshader"/>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="front"/>
        <input name="displacementshader" type="displacementshader" nodename="bumpy"/>
      </surfacematerial>)",
                                    diagnostics);
  const auto graph = build_graph(*document, standard_library(), {{}, "M"}, {}, diagnostics);
  ASSERT_TRUE(graph) << diagnostics.to_string();
  ASSERT_EQ(graph->outputs.size(), 2u);
  EXPECT_EQ(graph->outputs[0].name, "surfaceshader");
  EXPECT_EQ(graph->outputs[1].name, "displacementshader");
  EXPECT_EQ(graph->nodes.size(), 2u);  // the material node itself is gone
}

TEST(BuildGraph, MaterialsOfGraphsAreFound) {
  Diagnostics diagnostics;
  const auto document = document_of("<LamaSurface name=\"M\" type=\"material\"/>\n", diagnostics);
  const auto graph = build_graph(*document, standard_library(), {{}, "M"}, {}, diagnostics);
  ASSERT_TRUE(graph) << diagnostics.to_string();
  ASSERT_EQ(graph->outputs.size(), 2u);
  EXPECT_EQ(graph->outputs[0].name, "surfaceshader");
  EXPECT_EQ(graph->outputs[1].name, "backsurfaceshader");
}

TEST(BuildGraph, DeepChainsDoNotOverflowTheStack) {
  constexpr int depth = 100'000;
  std::string body = "<nodegraph name=\"NG\">\n<constant name=\"n0\" type=\"float\"/>\n";
  for (int i = 1; i <= depth; ++i) {
    body += fmt::format(
        "<sin name=\"n{}\" type=\"float\"><input name=\"in\" type=\"float\" nodename=\"n{}\"/>"
        "</sin>\n",
        i, i - 1);
  }
  body +=
      fmt::format("<output name=\"out\" type=\"float\" nodename=\"n{}\"/></nodegraph>\n", depth);
  const Graph graph = graph_of(body, {"NG/out"});
  EXPECT_EQ(graph.nodes.size(), depth + 1u);
}

TEST(BuildGraph, DeepCyclesAreRefused) {
  constexpr int depth = 100'000;
  std::string body;
  for (int i = 0; i < depth; ++i) {
    body += fmt::format(
        "<sin name=\"n{}\" type=\"float\"><input name=\"in\" type=\"float\" nodename=\"n{}\"/>"
        "</sin>\n",
        i, (i + 1) % depth);
  }
  body += "<output name=\"out\" type=\"float\" nodename=\"n7\"/>\n";
  Diagnostics diagnostics;
  const auto document = document_of(body, diagnostics);
  EXPECT_FALSE(build_graph(*document, standard_library(), {{"out"}, ""}, {}, diagnostics));
  ASSERT_EQ(diagnostics.error_count(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "cycle");
}

TEST(BuildGraph, DoublingGraphsStopAtTheNodeLimit) {
  std::string body =
      "<nodedef name=\"ND_f0\" node=\"f0\"><output name=\"out\" type=\"float\"/></nodedef>"
      "<nodegraph name=\"NG_f0\" nodedef=\"ND_f0\"><time name=\"t\" type=\"float\"/>"
      "<output name=\"out\" type=\"float\" nodename=\"t\"/></nodegraph>\n";
  for (int i = 1; i <= 40; ++i) {
    body += fmt::format(
        "<nodedef name=\"ND_f{0}\" node=\"f{0}\"><output name=\"out\" type=\"float\"/></nodedef>"
        "<nodegraph name=\"NG_f{0}\" nodedef=\"ND_f{0}\"><f{1} name=\"a\" type=\"float\"/>"
        "<f{1} name=\"b\" type=\"float\"/><add name=\"s\" type=\"float\">"
        "<input name=\"in1\" type=\"float\" nodename=\"a\"/>"
        "<input name=\"in2\" type=\"float\" nodename=\"b\"/></add>"
        "<output name=\"out\" type=\"float\" nodename=\"s\"/></nodegraph>\n",
        i, i - 1);
  }
  body +=
      "<f40 name=\"top\" type=\"float\"/><output name=\"out\" type=\"float\" nodename=\"top\"/>";
  Diagnostics diagnostics;
  const auto document = document_of(body, diagnostics);
  GraphOptions options;
  options.max_nodes = 10'000;
  EXPECT_FALSE(build_graph(*document, standard_library(), {{"out"}, ""}, options, diagnostics));
  ASSERT_FALSE(diagnostics.all().empty());
  EXPECT_EQ(diagnostics.all()[0].code, "too-many-nodes");
}

TEST(BuildGraph, ParametersCarryTheirInterface) {
  const Graph graph = graph_of(R"(<open_pbr_surface name="SR" type="surfaceshader">
                                    <input name="specular_roughness" type="float" value="0.3"/>
                                    <input name="geometry_thin_walled" type="boolean" value="true"/>
                                  </open_pbr_surface>
                                  <output name="out" type="surfaceshader" nodename="SR"/>)",
                               {"out"});
  ASSERT_EQ(graph.parameters.size(), 1u);
  const Parameter& roughness = graph.parameters[0];
  EXPECT_EQ(roughness.path, "SR/specular_roughness");
  EXPECT_EQ(roughness.nodedef, "ND_open_pbr_surface_surfaceshader");
  EXPECT_EQ(roughness.input, "specular_roughness");
  EXPECT_EQ(roughness.ui_name, "Specular Roughness");
  EXPECT_EQ(roughness.ui_min.floats, std::vector<float>{0});
  EXPECT_EQ(roughness.ui_max.floats, std::vector<float>{1});
  EXPECT_EQ(roughness.where.line, 2 + 1);
}

// Who reads an error knows no graph of a library, but the node that it stands for.
TEST(BuildGraph, NodesOfLibraryGraphsAreShownInTheDocument) {
  const Graph graph = graph_of(R"(<tiledimage name="wall" type="color3">
                                    <input name="file" type="filename" value="wall.png"/>
                                  </tiledimage>
                                  <nodegraph name="NG"><add name="sum" type="color3">
                                      <input name="in1" type="color3" nodename="own"/></add>
                                    <constant name="own" type="color3"/>
                                    <output name="out" type="color3" nodename="sum"/></nodegraph>
                                  <output name="out" type="color3" nodename="wall"/>)",
                               {"out", "NG/out"});
  bool has_image = false;
  for (const GraphNode& node : graph.nodes) {
    const bool is_own = node.path == "NG/sum" || node.path == "NG/own";
    if (!is_own) {
      EXPECT_EQ(node.where.line, 2) << node.path;
    }
    if (node.category == "image") {
      has_image = true;
      EXPECT_TRUE(node.path.starts_with("wall/")) << node.path;
      EXPECT_EQ(node.where.path, node.path);
    }
    if (node.path == "NG/sum") {
      EXPECT_EQ(node.where.line, 5);
    }
  }
  EXPECT_TRUE(has_image);
}

}  // namespace
}  // namespace nacre
