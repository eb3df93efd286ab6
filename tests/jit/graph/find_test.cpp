#include "jit/graph/find.h"

#include <gtest/gtest.h>

#include "tests/support/standard_library.h"

namespace nacre {
namespace {

constexpr std::string_view scene = R"(
  <nodedef name="ND_x" node="x"><output name="out" type="float"/></nodedef>
  <nodegraph name="NG_x" nodedef="ND_x">
    <constant name="c" type="float"/>
    <output name="out" type="float" nodename="c"/>
  </nodegraph>
  <output name="top" type="color3" nodename="r"/>
  <constant name="r" type="color3"/>
  <nodegraph name="NG">
    <constant name="c" type="float"/>
    <output name="a" type="float" nodename="c"/>
    <output name="b" type="float" nodename="c"/>
  </nodegraph>
  <standard_surface name="SR" type="surfaceshader"/>
  <surface_unlit name="loose" type="surfaceshader"/>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="SR"/>
  </surfacematerial>
  <look name="base">
    <materialassign name="all" material="M" geom="/a, /b" geomprefix="/scene"/>
  </look>
  <look name="shot" inherit="base">
    <materialassign name="some" material="M" collection="C" exclusive="false"/>
  </look>)";

TEST(Find, OutputsOfCompoundGraphsAndTheRoot) {
  Diagnostics diagnostics;
  const auto document = document_of(scene, diagnostics);
  std::vector<std::string> names;
  for (const FoundOutput& output : find_outputs(*document)) names.push_back(output.name);
  EXPECT_EQ(names, (std::vector<std::string>{"NG/a", "NG/b", "top"}));
}

TEST(Find, MaterialsWithTheirShaders) {
  Diagnostics diagnostics;
  const auto document = document_of(scene, diagnostics);
  const auto materials = find_materials(*document);
  ASSERT_EQ(materials.size(), 1u);
  EXPECT_EQ(materials[0].name, "M");
  EXPECT_EQ(materials[0].surfaceshader, "SR");
  EXPECT_EQ(materials[0].displacementshader, "");
}

TEST(Find, ShadersThatAMaterialInheritsOrTakesFromAnOutput) {
  Diagnostics diagnostics;
  const auto document = document_of(R"(
    <surface_unlit name="S" type="surfaceshader"/>
    <output name="o" type="surfaceshader" nodename="S"/>
    <surfacematerial name="A" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/>
    </surfacematerial>
    <surfacematerial name="B" type="material" inherit="A"/>
    <surfacematerial name="C" type="material">
      <input name="surfaceshader" type="surfaceshader" output="o"/>
    </surfacematerial>)",
                                    diagnostics);
  const auto materials = find_materials(*document);
  ASSERT_EQ(materials.size(), 3u);
  EXPECT_EQ(materials[1].surfaceshader, "S");
  EXPECT_EQ(materials[2].surfaceshader, "o");
}

TEST(Find, ShadersThatNoMaterialUses) {
  Diagnostics diagnostics;
  const auto document = document_of(scene, diagnostics);
  const Definitions definitions(*document, &standard_library().definitions(), diagnostics);
  const auto shaders = find_loose_shaders(*document, definitions);
  ASSERT_EQ(shaders.size(), 1u);
  EXPECT_EQ(shaders[0].name, "loose");
  EXPECT_EQ(shaders[0].type, Type::surfaceshader);
}

TEST(Find, LooksWithWhatTheyInherit) {
  Diagnostics diagnostics;
  const auto document = document_of(scene, diagnostics);
  const auto looks = find_looks(*document, diagnostics);
  ASSERT_EQ(looks.size(), 2u);
  EXPECT_EQ(looks[1].name, "shot");
  ASSERT_EQ(looks[1].assignments.size(), 2u);
  EXPECT_EQ(looks[1].assignments[0].geom, "/scene/a,/scene/b");
  EXPECT_TRUE(looks[1].assignments[0].exclusive);
  EXPECT_EQ(looks[1].assignments[1].collection, "C");
  EXPECT_FALSE(looks[1].assignments[1].exclusive);
}

}  // namespace
}  // namespace nacre
