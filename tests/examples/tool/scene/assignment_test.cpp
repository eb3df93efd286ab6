#include "examples/tool/scene/assignment.h"

#include <gtest/gtest.h>

#include "jit/document/read.h"

namespace nacre::tool {
namespace {

constexpr std::string_view text = R"(<materialx version="1.39">
  <surfacematerial name="M1" type="material"/>
  <surfacematerial name="M2" type="material"/>
  <surfacematerial name="M3" type="material"/>
  <collection name="doors" includegeom="/car//door_{left,right}" excludegeom="/car/wreck"/>
  <geominfo name="g" geom="/car"><token name="id" type="string" value="red"/></geominfo>
  <look name="first"><materialassign name="a" material="M1" geom="/"/></look>
  <look name="second" inherit="first">
    <materialassign name="a" material="M2" collection="doors"/>
    <materialassign name="b" material="M3" geom="Glass">
      <variantassign name="v" variantset="tint" variant="dark"/>
    </materialassign>
    <visibility name="c" geom="/car/body" vistype="camera" visible="false"/>
    <visibility name="d" geom="/car/wreck" visible="false"/>
  </look>
  <lookgroup name="looks" looks="first, second" default="second"/>
</materialx>)";

class AssignMaterials : public ::testing::Test {
 protected:
  MeshAssignment assign(const std::string& path, const std::string& material_name,
                        const AssignmentOptions& options = {}) {
    const auto document = read_document_text(text, "test.mtlx", {}, diagnostics_);
    host::Scene scene;
    host::Mesh& mesh = scene.meshes.emplace_back();
    mesh.path = path;
    mesh.object_name = mesh.mesh_name = path.substr(path.rfind('/') + 1);
    mesh.material_name = material_name;
    return assign_materials(*document, scene, options, diagnostics_).at(0);
  }

  Diagnostics diagnostics_;
};

TEST_F(AssignMaterials, ByTheDefaultLooksCollectionsAndNames) {
  EXPECT_EQ(assign("/car/body", "").material, "M1");
  EXPECT_EQ(assign("/car/front/door_left", "").material, "M2");
  EXPECT_EQ(assign("/car/wreck/door_left", "").material, "M1");
  EXPECT_EQ(assign("/bus/window", "Glass").material, "M3");
  EXPECT_EQ(assign("/bus/window", "Glass").variants.at(0).variant, "dark");
  // Each scene has one mesh, so that of three assignments one or two are on nothing.
  for (const Diagnostic& each : diagnostics_.all()) EXPECT_EQ(each.code, "unmatched-assignment");
}

TEST_F(AssignMaterials, OptionsAreStrongerThanLooks) {
  AssignmentOptions options;
  options.look = "first";
  EXPECT_EQ(assign("/car/front/door_left", "", options).material, "M1");
  options.look = "looks";
  options.assigns = {"door_left=M3"};
  EXPECT_EQ(assign("/car/front/door_left", "", options).material, "M3");
  options.assigns.clear();
  options.look = "third";
  assign("/car", "", options);
  EXPECT_EQ(diagnostics_.error_count(), 1u);
}

TEST_F(AssignMaterials, LooksHideMeshesAndGiveTokens) {
  EXPECT_EQ(assign("/car/body", "").visible_to, host::ray_shadow | host::ray_secondary);
  EXPECT_EQ(assign("/car/wreck/door_left", "").visible_to, 0u);
  EXPECT_EQ(assign("/bus", "").visible_to, host::ray_any);
  EXPECT_EQ(assign("/car/body", "").tokens.at("id"), "red");
  EXPECT_NE(assign("/car/body", "").key(), assign("/bus", "").key());
}

// The nearest says it; who is not meant, or has none, has 0.
TEST_F(AssignMaterials, PrioritiesOfDielectrics) {
  const auto priorities = [&](std::string_view properties) {
    const std::string document = R"(<materialx version="1.39">
      <surfacematerial name="M" type="material"/><propertyset name="high">
        <property name="dielectric_priority" type="integer" value="7"/></propertyset>
      <look name="only"><materialassign name="a" material="M" geom="/"/>)" +
                                 std::string(properties) + "</look></materialx>";
    const auto read = read_document_text(document, "test.mtlx", {}, diagnostics_);
    host::Scene scene;
    for (const char* path : {"/a", "/a/b", "/c"}) scene.meshes.emplace_back().path = path;
    std::vector<int> found;
    for (const auto& each : assign_materials(*read, scene, {}, diagnostics_)) {
      found.push_back(each.priority);
    }
    return found;
  };
  const std::string of = R"( property="dielectric_priority" type="integer" value=)";
  EXPECT_EQ(priorities(""), (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(priorities("<propertyassign name=\"p\"" + of + R"("3" geom="/a"/>)" +
                       "<propertyassign name=\"q\"" + of + R"("-4" geom="/a/b"/>)"),
            (std::vector<int>{3, -4, 0}));
  EXPECT_EQ(priorities(R"(<propertysetassign name="p" propertyset="high" geom="/c"/>)"),
            (std::vector<int>{0, 0, 7}));
  EXPECT_EQ(priorities("<propertyassign name=\"p\" target=\"another\"" + of + R"("3" geom="/"/>)"),
            (std::vector<int>{0, 0, 0}));
  EXPECT_EQ(diagnostics_.error_count(), 0u) << diagnostics_.to_string();
  priorities(R"(<propertyassign name="p" property="dielectric_priority" type="float" value="2"
                geom="/none"/>)");
  ASSERT_EQ(diagnostics_.error_count(), 1u) << diagnostics_.to_string();
  const auto& said = diagnostics_.all().back();
  EXPECT_EQ(said.code, "bad-priority");
  EXPECT_EQ(said.where.file, "test.mtlx");
  EXPECT_EQ(said.where.line, 4);
}

/// Geometry Extensions, "Geometry Representation": /path/mesh/partition.
TEST_F(AssignMaterials, PiecesOfAnObjectHaveNamesOfTheirOwn) {
  const auto document = read_document_text(R"(<materialx version="1.39">
    <surfacematerial name="M1" type="material"/>
    <surfacematerial name="M2" type="material"/>
    <surfacematerial name="M3" type="material"/>
    <look name="l"><materialassign name="a" material="M1" geom="/car/body"/>
      <materialassign name="b" material="M2" geom="/car/body/paint"/>
      <materialassign name="c" material="M3" geom="/car/seat/paint"/></look>
  </materialx>)",
                                           "test.mtlx", {}, diagnostics_);
  host::Scene scene;
  for (const auto& [path, material] :
       {std::pair{"/car/body", "paint"}, {"/car/body", "chrome"}, {"/car/seat", "paint"}}) {
    host::Mesh& mesh = scene.meshes.emplace_back();
    mesh.path = path;
    mesh.object_name = std::string(path).substr(5);
    mesh.material_name = material;
  }
  const auto assignments = assign_materials(*document, scene, {}, diagnostics_);
  EXPECT_EQ(assignments[0].material, "M2");
  EXPECT_EQ(assignments[1].material, "M1");
  EXPECT_EQ(assignments[2].material, "M1");  // It is whole: it has no partition.
}

}  // namespace
}  // namespace nacre::tool
