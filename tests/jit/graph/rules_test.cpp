// Rules of the MaterialX 1.39 specification, each by a small document.
#include <gtest/gtest.h>

#include "jit/graph/check/check.h"
#include "tests/jit/graph/build_text.h"

namespace nacre {
namespace {

// "Standard Node Inputs": a disabled node passes its default input or default on.
TEST(Disable, PassesTheDefaultInput) {
  constexpr std::string_view head = R"(
    <constant name="a" type="float"><input name="value" type="float" value="2" uniform="true"/></constant>
    <constant name="on" type="boolean"><input name="value" type="boolean" value="true"/></constant>
    <add name="n" type="float">
      <input name="in1" type="float" nodename="a"/>
      <input name="in2" type="float" value="1" uniform="true"/>)";
  constexpr std::string_view tail = R"(</add><output name="out" type="float" nodename="n"/>)";
  const auto text = [&](std::string_view disable) {
    return text_of(std::string(head) + std::string(disable) + std::string(tail), {"out"});
  };
  const std::string disabled =
      "%0 = ND_constant_float(value=2) : float\noutput \"out\" float = %0\n";
  EXPECT_EQ(text(R"(<input name="disable" type="boolean" value="true"/>)"), disabled);
  EXPECT_EQ(text(R"(<input name="disable" type="boolean" nodename="on"/>)"), disabled);
  EXPECT_NE(text(R"(<input name="disable" type="boolean" value="false"/>)"), disabled);
}

TEST(Disable, GivesTheDefaultOfAGraphToo) {
  constexpr std::string_view body = R"(
    <nodedef name="ND_x" node="x">
      <input name="in" type="float" value="1"/>
      <output name="out" type="float" default="0.25"/>
    </nodedef>
    <nodegraph name="NG_x" nodedef="ND_x">
      <sin name="s" type="float"><input name="in" type="float" interfacename="in"/></sin>
      <output name="out" type="float" nodename="s"/>
    </nodegraph>
    <nodegraph name="NG">
      <input name="off" type="boolean" value="true"/>
      <x name="n" type="float"><input name="disable" type="boolean" interfacename="off"/></x>
      <output name="out" type="float" nodename="n"/>
    </nodegraph>)";
  EXPECT_EQ(text_of(body, {"NG/out"}), "output \"NG/out\" float = 0.25\n");
}

// "Shader Nodes": an instance takes what it does not say from the one it inherits from.
TEST(InstanceInheritance, OverridesOneByOne) {
  constexpr std::string_view body = R"(
    <multiply name="base" type="float">
      <input name="in1" type="float" value="3" uniform="true"/>
      <input name="in2" type="float" value="5" uniform="true"/>
    </multiply>
    <multiply name="middle" type="float" inherit="base">
      <input name="in2" type="float" value="7" uniform="true"/>
    </multiply>
    <multiply name="last" type="float" inherit="middle"/>
    <output name="out" type="float" nodename="last"/>)";
  EXPECT_EQ(text_of(body, {"out"}),
            "%0 = ND_multiply_float(in1=3, in2=7) : float\noutput \"out\" float = %0\n");
}

// "Inputs": a uniform input takes constants through any number of dots and interfaces.
TEST(Uniform, ConstantsPassThroughDotsAndInterfaces) {
  constexpr std::string_view body = R"(
    <constant name="mode" type="string"><input name="value" type="string" value="clamp"/></constant>
    <dot name="d1" type="string"><input name="in" type="string" nodename="mode"/></dot>
    <nodegraph name="NG">
      <input name="m" type="string" nodename="d1"/>
      <dot name="d2" type="string"><input name="in" type="string" interfacename="m"/></dot>
      <image name="i" type="float">
        <input name="file" type="filename" value="a.exr"/>
        <input name="uaddressmode" type="string" nodename="d2"/>
      </image>
      <output name="out" type="float" nodename="i"/>
    </nodegraph>)";
  const Graph graph = graph_of(body, {"NG/out"});
  const GraphNode& image = graph.nodes.back();
  EXPECT_EQ(image.input("uaddressmode")->source.value.texts.at(0), "clamp");
}

// "MaterialX Data Types": arrays are uniform values of any length.
TEST(Arrays, PassThroughInterfacesAsValues) {
  constexpr std::string_view body = R"(
    <nodedef name="ND_x" node="x">
      <input name="knots" type="floatarray" value="0, 1"/>
      <input name="names" type="stringarray" value="a, b"/>
      <input name="points" type="vector2array" value=""/>
      <output name="out" type="float" default="1"/>
    </nodedef>
    <nodegraph name="NG">
      <input name="k" type="floatarray" value="0, 0.5, 1"/>
      <x name="n" type="float">
        <input name="knots" type="floatarray" interfacename="k"/>
        <input name="names" type="stringarray" value="x, y, z"/>
        <input name="points" type="vector2array" value="1, 2, 3, 4"/>
      </x>
      <output name="out" type="float" nodename="n"/>
    </nodegraph>)";
  GraphOptions options;
  options.is_native = [](std::string_view) { return true; };
  const Graph graph = graph_of(body, {"NG/out"}, options);
  ASSERT_EQ(graph.nodes.size(), 1u);
  EXPECT_EQ(graph.nodes[0].input("knots")->source.value.floats, (std::vector<float>{0, 0.5f, 1}));
  EXPECT_EQ(graph.nodes[0].input("names")->source.value.texts,
            (std::vector<std::string>{"x", "y", "z"}));
  EXPECT_EQ(graph.nodes[0].input("points")->source.value.floats, (std::vector<float>{1, 2, 3, 4}));
}

// "Color Spaces": the document's root names the working space, unless the host does.
TEST(WorkingSpace, IsTheDocumentsIfTheHostSaysNothing) {
  constexpr std::string_view body = R"(
    <constant name="c" type="color3">
      <input name="value" type="color3" value="1, 0, 0"/>
    </constant>
    <output name="out" type="color3" nodename="c"/>)";
  GraphOptions options;
  options.working_space = "";
  EXPECT_EQ(graph_of(body, {"out"}, options, "colorspace=\"acescg\"").nodes.size(), 1u);
  EXPECT_GT(graph_of(body, {"out"}, {}, "colorspace=\"acescg\"").nodes.size(), 1u);
}

// "Custom Data Types": structures, nested and with defaults, through interfaces, graphs
// and nodes. Each flows as its members, side by side.
constexpr std::string_view structures = R"(
  <typedef name="group"><member name="a" type="coord" value="{0.1; 0.2}"/>
    <member name="b" type="coord"/><member name="tint" type="color3" value="1, 0.5, 0"/></typedef>
  <typedef name="coord"><member name="s" type="float" value="0.5"/>
    <member name="t" type="integer" value="7"/></typedef>
  <nodedef name="ND_take" node="take">
    <input name="in" type="group" value="{{1;2};{3;4};5,6,7}"/><output name="out" type="float"/>
  </nodedef>
  <nodedef name="ND_make" node="make">
    <input name="x" type="float" value="0"/><output name="out" type="coord" default="{0.25;3}"/>
  </nodedef>
  <nodedef name="ND_takecoord" node="takecoord">
    <input name="in" type="coord"/><output name="out" type="float"/>
  </nodedef>
  <nodedef name="ND_wrap" node="wrap">
    <input name="g" type="group"/><output name="out" type="float"/>
  </nodedef>
  <nodegraph name="NG_wrap" nodedef="ND_wrap">
    <take name="n" type="float"><input name="in" type="group" interfacename="g"/></take>
    <output name="out" type="float" nodename="n"/>
  </nodegraph>
  <nodegraph name="NG">
    <input name="c" type="coord" value="{8; 9}"/>
    <takecoord name="n" type="float"><input name="in" type="coord" interfacename="c"/></takecoord>
    <make name="m" type="coord"/>
    <takecoord name="k" type="float"><input name="in" type="coord" nodename="m"/></takecoord>
    <output name="out" type="float" nodename="n"/>
    <output name="linked" type="float" nodename="k"/>
    <output name="whole" type="coord" nodename="m"/>
  </nodegraph>
  <take name="plain" type="float"/>
  <take name="set" type="float"><input name="in" type="group" value="{{0;1}; {2;3}; 4,5,6}"/></take>
  <wrap name="wrapped" type="float"/>
  <output name="plain_out" type="float" nodename="plain"/>
  <output name="set_out" type="float" nodename="set"/>
  <output name="wrapped_out" type="float" nodename="wrapped"/>)";

GraphOptions all_but(std::string_view graph) {
  GraphOptions options;
  options.is_native = [graph](std::string_view name) { return name != graph; };
  return options;
}

TEST(Structs, AreTheirMembersSideBySide) {
  const auto text = [](const char* output) {
    return text_of(structures, {output}, all_but("ND_wrap"));
  };
  EXPECT_EQ(text("plain_out"),
            "%0 = ND_take(in.a.s=1, in.a.t=2, in.b.s=3, in.b.t=4, in.tint=[5, 6, 7]) : float\n"
            "output \"plain_out\" float = %0\n");
  EXPECT_EQ(text("set_out"),
            "%0 = ND_take(in.a.s=0, in.a.t=1, in.b.s=2, in.b.t=3, in.tint=[4, 5, 6]) : float\n"
            "output \"set_out\" float = %0\n");
  // Without a value: what the members say, the outer ones first.
  EXPECT_EQ(
      text("wrapped_out"),
      "%0 = ND_take(in.a.s=0.1, in.a.t=0, in.b.s=0.5, in.b.t=7, in.tint=[1, 0.5, 0]) : float\n"
      "output \"wrapped_out\" float = %0\n");
  EXPECT_EQ(text("NG/out"),
            "%0 = ND_takecoord(in.s=8, in.t=9) : float\noutput \"NG/out\" float = %0\n");
}

TEST(Structs, FlowBetweenNodesAndOutOfGraphs) {
  const Graph linked = graph_of(structures, {"NG/linked"}, all_but("ND_wrap"));
  ASSERT_EQ(linked.nodes.size(), 2u);
  EXPECT_EQ(linked.nodes[1].input("in.t")->source.kind, Source::Kind::link);
  EXPECT_EQ(linked.nodes[1].input("in.t")->source.output, 1u);
  const Graph whole = graph_of(structures, {"NG/whole"}, all_but("ND_wrap"));
  ASSERT_EQ(whole.outputs.size(), 2u);
  EXPECT_EQ(whole.outputs[1].name, "NG/whole.t");
  EXPECT_EQ(whole.outputs[1].type, Type::integer);
  // Nothing implements make: its default.
  const Graph defaults = graph_of(structures, {"NG/linked"}, all_but("ND_make"));
  EXPECT_EQ(defaults.nodes[0].input("in.s")->source.value.floats.at(0), 0.25f);
  EXPECT_EQ(defaults.nodes[0].input("in.t")->source.value.ints.at(0), 3);
}

TEST(Structs, WrongOnesAreReported) {
  const auto errors = [](std::string_view body) {
    Diagnostics diagnostics;
    const auto document = document_of(body, diagnostics);
    check_document(*document, standard_library(), {}, diagnostics);
    return diagnostics.error_count();
  };
  EXPECT_EQ(errors(R"(<typedef name="t"><member name="m" type="t"/></typedef>)"), 1u);
  EXPECT_EQ(errors(R"(<typedef name="t"><member name="m" type="nothing"/></typedef>)"), 1u);
  EXPECT_EQ(errors(R"(<typedef name="t"><member name="m" type="float"/></typedef>
    <nodedef name="ND_x" node="x"><input name="i" type="t" value="{1;2}"/>
      <output name="out" type="float"/></nodedef>)"),
            1u);
  EXPECT_FALSE(split_struct_value("{1;2"));
  EXPECT_FALSE(split_struct_value("{1}{2}"));
  EXPECT_FALSE(split_struct_value("1;2"));
  EXPECT_EQ(split_struct_value("{{1;2}; 3 ;{{4}}}")->size(), 4u);
}

}  // namespace
}  // namespace nacre
