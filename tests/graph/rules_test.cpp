// Rules of the MaterialX 1.39 specification, each by a small document.
#include <gtest/gtest.h>

#include "tests/graph/build_text.h"

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

}  // namespace
}  // namespace nacre
