// Geometry Extensions of the MaterialX 1.39 specification.
#include "jit/graph/look/look.h"

#include <gtest/gtest.h>

#include "jit/graph/look/geometry_names.h"
#include "tests/jit/graph/build_text.h"

namespace nacre {
namespace {

TEST(GeometryNames, MatchWithinOneLevel) {
  EXPECT_TRUE(geom_matches("/a/b", "/a/b"));
  EXPECT_FALSE(geom_matches("/a/b", "/a/bc"));
  EXPECT_TRUE(geom_matches("/a/*", "/a/bc"));
  EXPECT_FALSE(geom_matches("/a/*", "/a/b/c"));
  EXPECT_TRUE(geom_matches("/*/wheel?", "/car/wheel3"));
  EXPECT_FALSE(geom_matches("/*/wheel?", "/car/wheel"));
  EXPECT_FALSE(geom_matches("/a?b", "/a/b"));
  EXPECT_TRUE(geom_matches("/g[1-3x]", "/g2"));
  EXPECT_TRUE(geom_matches("/g[1-3x]", "/gx"));
  EXPECT_FALSE(geom_matches("/g[1-3x]", "/g4"));
  EXPECT_TRUE(geom_matches("/a/{left,right}_*", "/a/right_door"));
  EXPECT_FALSE(geom_matches("/a/{left,right}_*", "/a/rear_door"));
  EXPECT_TRUE(geom_matches("/{a,{b,c}[12]}/x", "/c2/x"));
  EXPECT_TRUE(geom_matches("Queen_W", "/Queen_W"));
  EXPECT_TRUE(geom_matches("/", "/"));
  EXPECT_FALSE(geom_matches("/", "/a"));
}

// "a // will match a single /, or two /s any number of hierarchy levels apart"
TEST(GeometryNames, MatchAcrossLevels) {
  EXPECT_TRUE(geom_matches("/a//d", "/a/d"));
  EXPECT_TRUE(geom_matches("/a//d", "/a/b/c/d"));
  EXPECT_FALSE(geom_matches("/a//d", "/a/b/cd"));
  EXPECT_FALSE(geom_matches("/a//d", "/b/a/c"));
  // "//* by itself will match all leaf geometries", "//*// all geometries at any level"
  EXPECT_TRUE(geom_matches("//*", "/a/b", true));
  EXPECT_FALSE(geom_matches("//*", "/a", false));
  EXPECT_TRUE(geom_matches("//*//", "/a", false));
  EXPECT_TRUE(geom_matches("/a/b/c//*//", "/a/b/c/x/y", false));
  EXPECT_FALSE(geom_matches("/a/b/c//*//", "/a/b/x", true));
}

TEST(GeometryNames, ManyAlternativesAndStarsEnd) {
  std::string braces, stars;
  for (int i = 0; i < 64; ++i) braces += "{a,b}", stars += "*a";
  EXPECT_FALSE(geom_matches('/' + braces, '/' + std::string(64, 'a')));
  EXPECT_FALSE(geom_matches('/' + stars + 'b', '/' + std::string(2000, 'a')));
  EXPECT_EQ(split_geom_list("/a, /{b,c}/d ,").size(), 2u);
}

constexpr std::string_view looks = R"(
  <collection name="c_metal" includegeom="/a/g1, /a/g2, /a/c/g4" excludegeom="/a/c"/>
  <collection name="c_all" includegeom="/b/g4" includecollection="c_metal"/>
  <surfacematerial name="M1" type="material"/>
  <surfacematerial name="M2" type="material"/>
  <surfacematerial name="M3" type="material"/>
  <geominfo name="gi1" geom="/a/g1, /b"><token name="txtid" type="string" value="Lengine"/>
    <geomprop name="udimset" type="stringarray" value="1002,1003"/></geominfo>
  <tokendefault name="txtid" type="string" value="none"/>
  <tokendefault name="other" type="string" value="7"/>
  <propertyset name="set1"><property name="twosided" type="boolean" value="true"/>
    <property name="depth" target="rmanris" type="float" value="3"/></propertyset>
  <look name="base">
    <variantassign name="va" variantset="damage" variant="clean"/>
    <materialassign name="m1" material="M1" geom="/"/>
    <materialassign name="m2" material="M2" geom="/a/b/c"/>
    <visibility name="v1" geom="/a/g1" vistype="camera" visible="false"/>
    <visibility name="v2" geom="/b" visible="false"/>
    <visibility name="v3" geom="/b/g4" vistype="camera" visible="true"/>
    <visibility name="v4" geom="/a/g2" viewergeom="/lights/key" vistype="shadow" visible="false"/>
    <propertysetassign name="p1" propertyset="set1" geom="/a"/>
    <propertyassign name="p2" property="matte" type="boolean" value="true" geom="/a/g1"/>
  </look>
  <look name="child" inherit="base">
    <materialassign name="m3" material="M3" geom="/a/b"/>
    <materialassign name="m4" material="M3" collection="c_all">
      <variantassign name="vb" variantset="damage" variant="rusty"/>
    </materialassign>
    <propertyassign name="p3" property="twosided" type="boolean" value="false" geom="/a/g1"/>
  </look>
  <lookgroup name="inner" looks="child"/>
  <lookgroup name="all" looks="base, inner" default="child"/>)";

class Looks : public ::testing::Test {
 protected:
  Diagnostics diagnostics_;
  std::unique_ptr<Document> document_ = document_of(looks, diagnostics_);
  std::vector<Look> looks_ = find_looks(*document_, diagnostics_);
  GeometryRules rules_{*document_, diagnostics_};

  std::string material(std::size_t look, std::string_view geometry) {
    const Assignment* assignment = rules_.material_of(looks_.at(look), geometry);
    return assignment == nullptr ? "" : assignment->material;
  }
};

TEST_F(Looks, TheNearestAssignmentWinsThenTheLast) {
  EXPECT_EQ(material(0, "/x"), "M1");
  EXPECT_EQ(material(0, "/a/b/c/d"), "M2");
  EXPECT_EQ(material(1, "/a/b/x"), "M3");
  // A parent look's assignment nearer to the leaf is stronger than a child's above it.
  EXPECT_EQ(material(1, "/a/b/c/d"), "M2");
  EXPECT_TRUE(diagnostics_.all().empty()) << diagnostics_.to_string();
}

TEST(Assignments, ThatAreNotExclusiveLetOthersThrough) {
  Diagnostics diagnostics;
  const auto document = document_of(R"(
    <surfacematerial name="M" type="material"/>
    <look name="l">
      <materialassign name="a" material="A" geom="/"/>
      <materialassign name="b" material="B" geom="/x"/>
      <materialassign name="c" material="C" geom="/x" exclusive="false"/>
      <materialassign name="d" material="D" geom="/x/y" exclusive="false"/>
      <materialassign name="e" material="E" geom="/x" exclusive="false"/>
    </look>)",
                                    diagnostics);
  const Look look = find_looks(*document, diagnostics).at(0);
  const GeometryRules rules(*document, diagnostics);
  const auto names = [&](std::string_view geometry) {
    std::string text;
    for (const Assignment* each : rules.materials_of(look, geometry)) text += each->material;
    return text;
  };
  EXPECT_EQ(names("/x/y"), "DECB");
  EXPECT_EQ(names("/x"), "ECB");
  EXPECT_EQ(names("/z"), "A");
}

TEST_F(Looks, CollectionsIncludeThenExclude) {
  EXPECT_EQ(material(1, "/a/g1"), "M3");
  EXPECT_EQ(material(1, "/b/g4"), "M3");
  EXPECT_EQ(material(1, "/a/c/g4"), "M1");
}

TEST_F(Looks, VariantsAreOfTheLookAndOfTheAssignment) {
  ASSERT_EQ(looks_[1].variants.size(), 1u);
  EXPECT_EQ(looks_[1].variants[0].variant, "clean");
  EXPECT_EQ(rules_.material_of(looks_[1], "/a/g2")->variants.at(0).variant, "rusty");
}

TEST_F(Looks, VisibilityWithoutATypeIsTheStrongest) {
  EXPECT_FALSE(rules_.is_visible(looks_[0], "/a/g1", "camera"));
  EXPECT_TRUE(rules_.is_visible(looks_[0], "/a/g1", "shadow"));
  EXPECT_FALSE(rules_.is_visible(looks_[0], "/b/g4", "camera"));
  EXPECT_TRUE(rules_.is_visible(looks_[0], "/a/g2", "shadow"));
  EXPECT_FALSE(rules_.is_visible(looks_[0], "/a/g2", "shadow", "/lights/key"));
  EXPECT_TRUE(rules_.is_visible(looks_[0], "/a/g2", "shadow", "/lights/fill"));
}

TEST_F(Looks, PropertiesComeFromSetsAndAssignments) {
  EXPECT_EQ(rules_.property_of(looks_[0], "/a/g1", "twosided")->value.ints.at(0), 1);
  EXPECT_EQ(rules_.property_of(looks_[1], "/a/g1", "twosided")->value.ints.at(0), 0);
  EXPECT_EQ(rules_.property_of(looks_[0], "/a/g1", "matte")->value.ints.at(0), 1);
  EXPECT_EQ(rules_.property_of(looks_[0], "/a/g2", "matte"), nullptr);
  EXPECT_EQ(rules_.property_of(looks_[0], "/a/g2", "depth"), nullptr);
  EXPECT_EQ(rules_.property_of(looks_[0], "/a/g2", "depth", "rmanris")->value.floats.at(0), 3.0f);
}

TEST_F(Looks, GeometryHasTokensAndProperties) {
  EXPECT_EQ(rules_.tokens_of("/a/g1").at("txtid"), "Lengine");
  EXPECT_EQ(rules_.tokens_of("/b/deep").at("txtid"), "Lengine");
  EXPECT_EQ(rules_.tokens_of("/c").at("txtid"), "none");
  EXPECT_EQ(rules_.tokens_of("/a/g1").at("other"), "7");
  ASSERT_EQ(rules_.geomprops_of("/a/g1").size(), 1u);
  EXPECT_EQ(rules_.geomprops_of("/a/g1")[0].value.texts,
            (std::vector<std::string>{"1002", "1003"}));
  EXPECT_TRUE(rules_.geomprops_of("/c").empty());
}

TEST_F(Looks, GroupsResolveToLooks) {
  const auto groups = find_look_groups(*document_);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[1].looks, (std::vector<std::string>{"base", "child"}));
  EXPECT_EQ(groups[1].default_look, "child");
}

TEST(Collections, ThatIncludeThemselvesAreReported) {
  Diagnostics diagnostics;
  const auto document = document_of(R"(
    <collection name="a" includecollection="b"/><collection name="b" includecollection="a"/>)",
                                    diagnostics);
  const GeometryRules rules(*document, diagnostics);
  EXPECT_EQ(diagnostics.error_count(), 2u);
  EXPECT_FALSE(rules.reach({"", "a"}, "/x"));
}

constexpr std::string_view varied = R"(
  <variantset name="damage" node="standard_surface">
    <variant name="clean"><input name="base" type="float" value="0.5" uniform="true"/></variant>
    <variant name="rusty"><input name="base" type="float" value="0.25" uniform="true"/>
      <input name="metalness" type="float" value="1" uniform="true"/></variant>
  </variantset>
  <variantset name="tex">
    <variant name="wood"><token name="kind" type="string" value="wood"/></variant>
  </variantset>
  <token name="kind" type="string" value="stone"/>
  <image name="i" type="color3"><input name="file" type="filename" value="[kind].png"/></image>
  <standard_surface name="SR" type="surfaceshader">
    <input name="base" type="float" value="1" uniform="true"/>
    <input name="base_color" type="color3" nodename="i"/>
  </standard_surface>
  <output name="out" type="surfaceshader" nodename="SR"/>)";

TEST(Variants, ReplaceInputsAndTokens) {
  GraphOptions options;
  options.is_native = [](std::string_view) { return true; };
  const auto input = [&](const char* name) {
    const Graph graph = graph_of(varied, {"out"}, options);
    return graph.nodes.back().input(name)->source.value.floats.at(0);
  };
  EXPECT_EQ(input("base"), 1.0f);
  options.variants = {{"damage", "clean"}};
  EXPECT_EQ(input("base"), 0.5f);
  EXPECT_EQ(input("metalness"), 0.0f);
  options.variants = {{"damage", "clean"}, {"damage", "rusty"}, {"tex", "wood"}};
  EXPECT_EQ(input("base"), 0.25f);
  EXPECT_EQ(input("metalness"), 1.0f);
  const Graph graph = graph_of(varied, {"out"}, options);
  for (const GraphNode& node : graph.nodes) {
    if (node.category != "image") continue;
    EXPECT_EQ(node.input("file")->source.value.texts[0], "wood.png");
  }
}

TEST(Variants, UnknownOnesAreErrors) {
  Diagnostics diagnostics;
  const auto document = document_of(varied, diagnostics);
  GraphOptions options;
  options.variants = {{"damage", "burnt"}, {"age", "old"}};
  EXPECT_FALSE(build_graph(*document, standard_library(), {{"out"}, ""}, options, diagnostics));
  ASSERT_EQ(diagnostics.error_count(), 2u);
  EXPECT_EQ(diagnostics.all()[0].code, "unknown-variant");
}

}  // namespace
}  // namespace nacre
