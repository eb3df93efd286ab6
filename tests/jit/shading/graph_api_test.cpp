// What a host with a scene format of its own does: finds nodedefs, builds a network,
// compiles it, and changes values afterwards.
#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "jit/graph/build/builder.h"
#include "jit/shading/shading_system.h"

namespace nacre {
namespace {

class GraphApi : public ::testing::Test {
 protected:
  void SetUp() override {
    system_ = ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
  }

  const NodeDef& nodedef(std::string_view name) {
    return *system_->library().definitions().nodedef(name);
  }

  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

Value number(float x) { return {Type::float_, {x}, {}, {}}; }
Value color(float r, float g, float b) { return {Type::color3, {r, g, b}, {}, {}}; }
Value text(Type type, std::string value) { return {type, {}, {}, {std::move(value)}}; }

/// The inputs of the UsdPreviewSurface proposal, with their defaults and ranges.
TEST_F(GraphApi, NodeDefsSayWhatAHostShows) {
  const NodeDef& surface = nodedef("ND_UsdPreviewSurface_surfaceshader");
  EXPECT_EQ(surface.category, "UsdPreviewSurface");
  std::set<std::string_view> names;
  for (const NodeDefInput& input : surface.inputs) names.insert(input.name);
  for (const char* name : {"diffuseColor", "emissiveColor", "useSpecularWorkflow", "specularColor",
                           "metallic", "roughness", "clearcoat", "clearcoatRoughness", "opacity",
                           "opacityThreshold", "ior", "normal", "displacement", "occlusion"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  const NodeDefInput& roughness = *surface.input("roughness");
  EXPECT_EQ(roughness.type, Type::float_);
  EXPECT_EQ(roughness.default_value, number(0.5f));
  EXPECT_EQ(ui_of(roughness).min, number(0.0f));
  EXPECT_EQ(ui_of(roughness).max, number(1.0f));
  EXPECT_EQ(surface.input("useSpecularWorkflow")->type, Type::integer);
  EXPECT_EQ(surface.input("useSpecularWorkflow")->default_value.ints.at(0), 0);
  EXPECT_EQ(surface.input("normal")->default_value.floats, (std::vector<float>{0, 0, 1}));
}

TEST_F(GraphApi, UnitsFoldersChoicesAndDocumentation) {
  EXPECT_EQ(nodedef("ND_rotate2d_vector2").input("amount")->unit, "degree");
  EXPECT_EQ(nodedef("ND_rotate2d_vector2").input("amount")->unit_type, "angle");
  const NodeDef& standard = nodedef("ND_standard_surface_surfaceshader");
  EXPECT_EQ(ui_of(*standard.input("base")).folder, "Base");
  EXPECT_EQ(ui_of(*standard.input("specular_IOR")).soft_max, number(3.0f));
  EXPECT_FALSE(ui_of(*standard.input("base")).doc.empty());
  const auto address = enum_choices(*nodedef("ND_image_color3").input("uaddressmode"));
  ASSERT_EQ(address.size(), 4u);
  EXPECT_EQ(address[2].value, text(Type::string, "periodic"));
  // Labels of other types stand for numbers of several components.
  const auto coefficients = enum_choices(*nodedef("ND_luminance_color3").input("lumacoeffs"));
  ASSERT_EQ(coefficients.size(), 4u);
  EXPECT_EQ(coefficients[1].label, "rec709");
  ASSERT_EQ(coefficients[1].value.floats.size(), 3u);
  EXPECT_NEAR(coefficients[1].value.floats[1], 0.7152, 1e-3);
}

/// As a USD importer would: a texture read by st, scaled, into diffuseColor, and values.
class UsdNetwork {
 public:
  UsdNetwork(const Library& library, float threshold) : builder_(library) {
    const auto reader = builder_.add_node("ND_UsdPrimvarReader_vector2", "/Mat/stReader");
    builder_.set(reader, "varname", text(Type::string, "st"));
    const auto transform = builder_.add_node("ND_UsdTransform2d", "/Mat/st");
    builder_.connect(transform, "in", reader);
    builder_.set(transform, "scale", {Type::vector2, {2, 2}, {}, {}});
    const auto texture = builder_.add_node("ND_UsdUVTexture_23", "/Mat/diffuse");
    builder_.set(texture, "file", text(Type::filename, ""), "srgb_texture");
    builder_.set(texture, "fallback", {Type::color4, {0.5f, 0.5f, 0.5f, 1}, {}, {}});
    builder_.connect(texture, "st", transform);
    const auto surface = builder_.add_node("ND_UsdPreviewSurface_surfaceshader", "/Mat/Surface");
    builder_.connect(surface, "diffuseColor", texture, "rgb");
    builder_.connect(surface, "emissiveColor",
                     builder_.parameter("/Mat.emission", color(0.2f, 0.3f, 0.4f)));
    builder_.connect(surface, "roughness", builder_.parameter("/Mat.roughness", number(0.4f)));
    builder_.set(surface, "opacityThreshold", number(threshold));
    builder_.output("surfaceshader", surface);
  }

  std::optional<Graph> finish(const GraphOptions& options, Diagnostics& diagnostics) {
    return builder_.finish(options, diagnostics);
  }

 private:
  GraphBuilder builder_;
};

std::vector<float> emission(const BoundKernel& kernel,
                            const std::vector<std::uint32_t>& parameters) {
  std::vector<float> zero(1), values(kernel.program().outputs.size());
  std::vector<const void*> in(kernel.program().inputs.size(), zero.data());
  std::vector<void*> out;
  for (float& value : values) out.push_back(&value);
  EXPECT_EQ(kernel.run(in, out, 1, parameters), RunStatus::done);
  return values;
}

TEST_F(GraphApi, AUsdNetworkCompilesAndItsValuesChange) {
  ShaderOptions options;
  options.parameters = ParameterMode::live;
  auto graph =
      UsdNetwork(system_->library(), 0).finish(system_->graph_options(options), diagnostics_);
  ASSERT_TRUE(graph) << diagnostics_.to_string();
  const std::uint64_t topology = topology_hash(*graph);
  const auto kernels = system_->compile_material(*graph, options, diagnostics_);
  ASSERT_TRUE(kernels && kernels->emission && kernels->evaluate) << diagnostics_.to_string();

  // A surface emits its emissiveColor.
  const BoundKernel& kernel = *kernels->emission;
  EXPECT_EQ(emission(kernel, kernel.parameters()), (std::vector<float>{0.2f, 0.3f, 0.4f}));

  // In the kernel: the slot of the parameter's name.
  std::vector<std::uint32_t> block = kernel.parameters();
  block.at(*kernel.parameter_index("/Mat.emission.y")) = std::bit_cast<std::uint32_t>(0.75f);
  EXPECT_EQ(emission(kernel, block), (std::vector<float>{0.2f, 0.75f, 0.4f}));

  // In the graph: the same topology, so the cache has the code already.
  Parameter* parameter = find_parameter(*graph, "/Mat.emission");
  ASSERT_NE(parameter, nullptr);
  parameter->value = color(1, 2, 3);
  EXPECT_EQ(topology_hash(*graph), topology);
  const auto again = system_->compile_material(*graph, options, diagnostics_);
  EXPECT_EQ(emission(*again->emission, again->emission->parameters()),
            (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(find_parameter(*graph, "/Mat.metallic"), nullptr);
}

TEST_F(GraphApi, ADifferentLiteralIsADifferentTopology) {
  const GraphOptions options = system_->graph_options({});
  const auto one = UsdNetwork(system_->library(), 0).finish(options, diagnostics_);
  const auto same = UsdNetwork(system_->library(), 0).finish(options, diagnostics_);
  const auto other = UsdNetwork(system_->library(), 0.5f).finish(options, diagnostics_);
  ASSERT_TRUE(one && same && other) << diagnostics_.to_string();
  EXPECT_EQ(topology_hash(*one), topology_hash(*same));
  EXPECT_NE(topology_hash(*one), topology_hash(*other));
}

}  // namespace
}  // namespace nacre
