#include "jit/document/nodedef.h"

#include <gtest/gtest.h>

#include <set>

#include "jit/document/select.h"
#include "tests/support/standard_library.h"

namespace nacre {
namespace {

const NodeDef& nodedef(std::string_view name) {
  const NodeDef* def = standard_library().definitions().nodedef(name);
  EXPECT_NE(def, nullptr) << name;
  static const NodeDef none;
  return def != nullptr ? *def : none;
}

// The nodedef of the only node in a document.
std::string selected(std::string_view body) {
  Diagnostics diagnostics;
  const auto document = document_of(body, diagnostics);
  const Definitions definitions(*document, &standard_library().definitions(), diagnostics);
  for (const Element& child : document->root().children()) {
    if (!is_node(child)) continue;
    const NodeDef* def = find_nodedef(child, definitions, diagnostics);
    return def != nullptr ? std::string(def->name) : diagnostics.all().back().code;
  }
  return "no node";
}

TEST(Library, NodeDefsAreThoseOfMaterialX) {
  const Definitions& definitions = standard_library().definitions();
  const std::vector<const NodeDef*> all = definitions.all();
  // Counted in the 1.39.5 release with another XML parser.
  std::set<std::string_view> names;
  std::size_t with_graph = 0;
  for (const NodeDef* def : all) {
    EXPECT_TRUE(names.insert(def->name).second) << def->name;
    EXPECT_FALSE(def->outputs.empty()) << def->name;
    EXPECT_FALSE(def->category.empty()) << def->name;
    for (const NodeDefInput& input : def->inputs) EXPECT_NE(input.type, Type::none) << def->name;
    if (definitions.graph_of(*def) != nullptr) ++with_graph;
  }
  EXPECT_EQ(all.size(), 806u);
  EXPECT_EQ(with_graph, 266u);
}

TEST(NodeDef, HoldsTypesAndDefaults) {
  const NodeDef& mix = nodedef("ND_mix_color3");
  EXPECT_EQ(mix.category, "mix");
  EXPECT_EQ(mix.nodegroup, "compositing");
  ASSERT_EQ(mix.inputs.size(), 3u);
  EXPECT_EQ(mix.inputs[2].name, "mix");
  EXPECT_EQ(mix.inputs[2].type, Type::float_);
  EXPECT_EQ(mix.inputs[2].default_value.floats, std::vector<float>{0});
  EXPECT_EQ(mix.outputs.at(0).defaultinput, "bg");
  EXPECT_EQ(mix.instance_type(), "color3");
}

TEST(NodeDef, KnowsUniformEnumAndGeomprop) {
  const NodeDef& image = nodedef("ND_image_color3");
  EXPECT_TRUE(image.input("file")->uniform);
  EXPECT_EQ(image.input("texcoord")->defaultgeomprop, "UV0");
  const std::vector<std::string_view> modes{"constant", "clamp", "periodic", "mirror"};
  EXPECT_EQ(image.input("uaddressmode")->enums, modes);
  EXPECT_EQ(nodedef("ND_rotate2d_vector2").input("amount")->unit, "degree");
}

TEST(NodeDef, InheritsPortsItDoesNotHave) {
  const NodeDef& base = nodedef("ND_standard_surface_surfaceshader_100");
  const NodeDef& derived = nodedef("ND_standard_surface_surfaceshader");
  EXPECT_EQ(derived.version, "1.0.1");
  for (const NodeDefInput& input : base.inputs) {
    EXPECT_NE(derived.input(input.name), nullptr) << input.name;
  }
  EXPECT_EQ(derived.outputs.size(), 1u);
  // What both declare is the heir's: 1.0.1 changed `base` from 0.8 to 1.
  EXPECT_EQ(base.input("base")->default_value.floats, std::vector<float>{0.8f});
  EXPECT_EQ(derived.input("base")->default_value.floats, std::vector<float>{1.0f});
}

TEST(NodeDef, SeveralOutputsMakeAMultioutput) {
  EXPECT_EQ(nodedef("ND_artistic_ior").instance_type(), "multioutput");
  EXPECT_EQ(nodedef("ND_artistic_ior").outputs.size(), 2u);
}

TEST(SelectNodeDef, ByOutputType) {
  EXPECT_EQ(selected("<noise2d name=\"n\" type=\"vector3\"/>"), "ND_noise2d_vector3");
}

TEST(SelectNodeDef, ByInputTypes) {
  EXPECT_EQ(selected("<multiply name=\"n\" type=\"color3\">"
                     "<input name=\"in2\" type=\"float\" value=\"2\"/></multiply>"),
            "ND_multiply_color3FA");
  EXPECT_EQ(selected("<multiply name=\"n\" type=\"color3\">"
                     "<input name=\"in2\" type=\"color3\" value=\"2,2,2\"/></multiply>"),
            "ND_multiply_color3");
}

TEST(SelectNodeDef, UnwrittenInputsDoNotVote) {
  EXPECT_EQ(selected("<multiply name=\"n\" type=\"color3\">"
                     "<input name=\"in1\" type=\"color3\" value=\"2,2,2\"/></multiply>"),
            "ND_multiply_color3");
}

TEST(SelectNodeDef, ExplicitNameDecides) {
  EXPECT_EQ(selected("<multiply name=\"n\" type=\"color3\" nodedef=\"ND_multiply_color3FA\"/>"),
            "ND_multiply_color3FA");
}

TEST(SelectNodeDef, ExplicitNameDecidesOverTheCategory) {
  EXPECT_EQ(selected("<ifgreater name=\"n\" type=\"color4\" nodedef=\"ND_ifgreatereq_color4I\"/>"),
            "ND_ifgreatereq_color4I");
}

TEST(SelectNodeDef, DefaultVersionUnlessOneIsNamed) {
  EXPECT_EQ(selected("<standard_surface name=\"n\" type=\"surfaceshader\"/>"),
            "ND_standard_surface_surfaceshader");
  EXPECT_EQ(selected("<standard_surface name=\"n\" type=\"surfaceshader\" version=\"1.0.0\"/>"),
            "ND_standard_surface_surfaceshader_100");
}

TEST(SelectNodeDef, OtherTargetsDoNotCount) {
  EXPECT_EQ(selected("<nodedef name=\"ND_x\" node=\"x\" target=\"genosl\">"
                     "<output name=\"out\" type=\"float\"/></nodedef>"
                     "<x name=\"n\" type=\"float\"/>"),
            "unknown-node");
  EXPECT_EQ(selected("<nodedef name=\"ND_x\" node=\"x\" target=\"genosl, nacre\">"
                     "<output name=\"out\" type=\"float\"/></nodedef>"
                     "<x name=\"n\" type=\"float\"/>"),
            "ND_x");
}

TEST(SelectNodeDef, LibraryComesBeforeTheDocument) {
  EXPECT_EQ(selected("<nodedef name=\"ND_my_sin\" node=\"sin\">"
                     "<input name=\"in\" type=\"float\" value=\"0\"/>"
                     "<output name=\"out\" type=\"float\"/></nodedef>"
                     "<sin name=\"n\" type=\"float\"/>"),
            "ND_sin_float");
}

TEST(SelectNodeDef, OwnNamespaceComesFirst) {
  EXPECT_EQ(selected("<nodedef name=\"ND_my_sin\" node=\"sin\" namespace=\"mine\">"
                     "<input name=\"in\" type=\"float\" value=\"0\"/>"
                     "<output name=\"out\" type=\"float\"/></nodedef>"
                     "<mine:sin name=\"n\" type=\"float\"/>"),
            "ND_my_sin");
  EXPECT_EQ(selected("<nodedef name=\"ND_my_sin\" node=\"sin\" namespace=\"mine\">"
                     "<input name=\"in\" type=\"float\" value=\"0\"/>"
                     "<output name=\"out\" type=\"float\"/></nodedef>"
                     "<sin name=\"n\" type=\"float\" namespace=\"mine\"/>"),
            "ND_my_sin");
}

TEST(Definitions, ImplementationNamesAGraph) {
  Diagnostics diagnostics;
  const auto document = document_of(
      "<nodedef name=\"ND_x\" node=\"x\"><output name=\"out\" type=\"float\"/></nodedef>"
      "<nodegraph name=\"NG_x\"><constant name=\"c\" type=\"float\"/>"
      "<output name=\"out\" type=\"float\" nodename=\"c\"/></nodegraph>"
      "<implementation name=\"IM_x\" nodedef=\"ND_x\" nodegraph=\"NG_x\"/>",
      diagnostics);
  const Definitions definitions(*document, &standard_library().definitions(), diagnostics);
  EXPECT_EQ(definitions.graph_of(*definitions.nodedef("ND_x")), document->root().child("NG_x"));
}

TEST(Definitions, ImplementationsForThisTargetComeFirst) {
  Diagnostics diagnostics;
  const auto document = document_of(R"(
    <nodedef name="ND_x" node="x"><output name="out" type="float"/></nodedef>
    <nodegraph name="NG_all" nodedef="ND_x"><output name="out" type="float"/></nodegraph>
    <nodegraph name="NG_other" nodedef="ND_x" target="genglsl"/>
    <nodegraph name="NG_ours" nodedef="ND_x" target="genosl, nacre"/>)",
                                    diagnostics);
  const Definitions definitions(*document, nullptr, diagnostics);
  EXPECT_EQ(definitions.graph_of(*definitions.nodedef("ND_x"))->name(), "NG_ours");
}

TEST(Definitions, UnitsComeFromTheLibrary) {
  const Definitions& definitions = standard_library().definitions();
  EXPECT_EQ(definitions.unit("mile")->scale, 1609.344);
  EXPECT_EQ(definitions.unit("mile")->type, "distance");
  EXPECT_EQ(definitions.unit("degree")->type, "angle");
  EXPECT_FALSE(definitions.unit("furlong"));
}

}  // namespace
}  // namespace nacre
