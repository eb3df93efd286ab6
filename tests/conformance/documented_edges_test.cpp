#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "examples/common/materialx_libraries.h"
#include "jit/shading/shading_system.h"
#include "tests/conformance/sweep.h"

namespace nacre {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A node with these inputs, by component, and its first output; the rest is 0.5.
struct Edge {
  const char* nodedef;
  std::map<std::string, std::vector<float>> inputs;
  std::vector<float> expected;
};

/// What the comments beside the nodes promise.
std::vector<Edge> edges() {
  const std::vector<float> z{0, 0, 1};
  const std::map<std::string, std::vector<float>> flake{
      {"normal", z}, {"tangent", {1, 0, 0}}, {"bitangent", {0, 1, 0}}, {"coverage", {0}}};
  const auto normalmap = [&](std::vector<float> in, std::vector<float> tangent) {
    return std::map<std::string, std::vector<float>>{{"in", std::move(in)},
                                                     {"normal", z},
                                                     {"tangent", std::move(tangent)},
                                                     {"bitangent", {0, 1, 0}},
                                                     {"scale", {1}}};
  };
  const auto fractal = [](float lacunarity, float diminish) {
    return std::map<std::string, std::vector<float>>{
        {"amplitude", {1}}, {"lacunarity", {lacunarity}}, {"diminish", {diminish}}};
  };
  return {
      // Sums and products are IEEE's.
      {"ND_add_float", {{"in1", {inf}}, {"in2", {-inf}}}, {nan}},
      {"ND_add_float", {{"in1", {3e38f}}, {"in2", {3e38f}}}, {inf}},
      {"ND_multiply_float", {{"in1", {0}}, {"in2", {inf}}}, {nan}},
      {"ND_multiply_float", {{"in1", {1e-30f}}, {"in2", {1e-30f}}}, {0}},
      {"ND_invert_float", {{"in", {inf}}, {"amount", {1}}}, {-inf}},
      {"ND_dotproduct_vector2", {{"in1", {1e30f, 0}}, {"in2", {1e30f, 1}}}, {inf}},
      {"ND_crossproduct_vector3", {{"in1", {inf, 0, 0}}, {"in2", {0, 1, 0}}}, {0, nan, inf}},
      {"ND_luminance_color3", {{"in", {inf, 0, 0}}, {"lumacoeffs", {0, 1, 0}}}, {nan, nan, nan}},
      // Compositing extrapolates, and 0 times infinity is NaN.
      {"ND_mix_float", {{"fg", {2}}, {"bg", {1}}, {"mix", {3}}}, {4}},
      {"ND_mix_float", {{"fg", {inf}}, {"bg", {1}}, {"mix", {0}}}, {nan}},
      {"ND_plus_float", {{"fg", {inf}}, {"bg", {1}}, {"mix", {0}}}, {nan}},
      {"ND_screen_float", {{"fg", {-1}}, {"bg", {inf}}, {"mix", {1}}}, {inf}},
      {"ND_screen_float", {{"fg", {2}}, {"bg", {inf}}, {"mix", {1}}}, {nan}},
      {"ND_premult_color4", {{"in", {inf, 1, 1, 0}}}, {nan, 0, 0, 0}},
      {"ND_unpremult_color4", {{"in", {inf, 1, -1, 0}}}, {inf, 1, -1, 0}},
      {"ND_unpremult_color4", {{"in", {1, 1, -1, inf}}}, {0, 0, 0, inf}},
      {"ND_unpremult_color4", {{"in", {1e30f, 0, -1e30f, 1e-30f}}}, {inf, 0, -inf, 1e-30f}},
      // Functions outside their domains.
      {"ND_absval_float", {{"in", {-inf}}}, {inf}},
      {"ND_acos_float", {{"in", {inf}}}, {0}},
      {"ND_acos_float", {{"in", {nan}}}, {nan}},
      {"ND_asin_float", {{"in", {nan}}}, {nan}},
      {"ND_divide_float", {{"in1", {1}}, {"in2", {0}}}, {0}},
      {"ND_divide_float", {{"in1", {nan}}, {"in2", {1}}}, {0}},
      {"ND_rotate3d_vector3",
       {{"in", {1, 0, 0}}, {"amount", {0}}, {"axis", {0, 0, inf}}},
       {nan, nan, nan}},
      {"ND_remap_float", {{"in", {nan}}, {"outlow", {3}}}, {3}},
      {"ND_remap_float", {{"in", {inf}}, {"inlow", {0}}, {"outlow", {3}}}, {3}},
      {"ND_hsvtorgb_color3", {{"in", {0.3f, nan, 2}}}, {2, 2, 2}},
      {"ND_rgbtohsv_color3", {{"in", {inf, 0, 0}}}, {0, nan, inf}},
      // Ramps, splits and noise.
      {"ND_ramplr_float", {{"valuel", {1}}, {"valuer", {2}}, {"texcoord", {nan, 0}}}, {1}},
      {"ND_ramptb_float", {{"valueb", {1}}, {"valuet", {inf}}, {"texcoord", {0, 0}}}, {nan}},
      {"ND_splitlr_float",
       {{"valuel", {1}}, {"valuer", {2}}, {"center", {0}}, {"texcoord", {inf, 0}}},
       {2}},
      {"ND_splittb_float",
       {{"valueb", {1}}, {"valuet", {2}}, {"center", {0}}, {"texcoord", {0, -inf}}},
       {1}},
      {"ND_splitlr_float", {{"texcoord", {nan, 0}}}, {nan}},
      {"ND_noise2d_float",
       {{"texcoord", {1e30f, -inf}}, {"amplitude", {1}}, {"pivot", {0.25f}}},
       {0.25f}},
      {"ND_noise3d_float",
       {{"position", {nan, inf, 1e8f}}, {"amplitude", {1}}, {"pivot", {0.25f}}},
       {0.25f}},
      {"ND_noise2d_float", {{"texcoord", {2, 3}}, {"amplitude", {inf}}}, {nan}},
      {"ND_fractal2d_float", fractal(inf, 0.5f), {0}},
      {"ND_fractal3d_float", fractal(2.0f, nan), {nan}},
      {"ND_worleynoise2d_float", {{"texcoord", {nan, 0}}, {"jitter", {1}}}, {1000}},
      {"ND_worleynoise2d_float", {{"texcoord", {inf, 0}}, {"jitter", {1}}}, {1000}},
      {"ND_worleynoise3d_float", {{"jitter", {1e30f}}}, {1000}},
      {"ND_worleynoise3d_float", {{"jitter", {nan}}}, {1000}},
      {"ND_flake2d", flake, {0}},
      {"ND_flake3d", flake, {0}},
      // Frames and hair.
      {"ND_normalmap_float", normalmap({0.5f, 0.5f, 0.5f}, {1, 0, 0}), {0, 0, 0}},
      {"ND_normalmap_float", normalmap({0.7f, 0.5f, 1}, {0, 0, 0}), {0, 0, 1}},
      {"ND_normalmap_float", normalmap({0.7f, 0.5f, 1}, z), {0, 0, 1}},
      {"ND_normalmap_float", normalmap({nan, 0.5f, 1}, {1, 0, 0}), {nan, nan, nan}},
      {"ND_deon_hair_absorption_from_melanin", {{"melanin_redness", {nan}}}, {0, 0, 0}},
      {"ND_chiang_hair_absorption_from_color", {{"azimuthal_roughness", {1e30f}}}, {0, 0, 0}},
      {"ND_artistic_ior", {{"reflectivity", {nan, nan, nan}}}, {1, 1, 1}},
      {"ND_roughness_dual", {{"roughness", {nan, nan}}}, {1e-8f, 1e-8f}},
  };
}

class DocumentedEdges : public ::testing::TestWithParam<Backend> {
 protected:
  void SetUp() override {
    system_ = ShadingSystem::create({.libraries = {find_materialx_libraries()}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
  }

  /// The first output of a node, by component.
  std::vector<float> first_output(const std::string& nodedef,
                                  const std::map<std::string, std::vector<float>>& inputs) {
    const NodeDef* def = system_->library().definitions().nodedef(nodedef);
    if (def == nullptr) return {};
    ShaderOptions options;
    options.compile.backend = GetParam();
    const auto graph =
        testing::Sweep(system_->library(), *def).finish(system_->graph_options({}), diagnostics_);
    if (!graph) return {};
    const auto shader = system_->compile_outputs(*graph, options, diagnostics_);
    if (shader == nullptr) return {};
    const Program& program = shader->kernel.program();
    testing::Arrays arrays;
    for (const Channel& channel : program.inputs) {
      arrays[channel.name] = {value(channel, inputs)};
    }
    const testing::Arrays out = testing::run(shader->kernel, arrays, 1);
    std::vector<float> result;
    const int count = component_count(def->outputs.front().type);
    for (int i = 0; i < count; ++i) {
      const Channel& channel = program.outputs[static_cast<std::size_t>(i)];
      const std::uint32_t bits = out.at(channel.name)[0];
      const bool is_float = channel.type == Scalar::f32;
      result.push_back(is_float ? std::bit_cast<float>(bits) : static_cast<float>(bits));
    }
    return result;
  }

  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;

 private:
  /// Of "geomprop.PORT.x": a component of the port's value, 0.5 or 2.
  static std::uint32_t value(const Channel& channel,
                             const std::map<std::string, std::vector<float>>& inputs) {
    const std::size_t dot = channel.name.rfind('.');
    const std::size_t first = channel.name.find('.') + 1;
    const auto given = inputs.find(channel.name.substr(first, dot - first));
    if (channel.type != Scalar::f32) return channel.type == Scalar::b1 ? 0 : 2;
    if (given == inputs.end()) return std::bit_cast<std::uint32_t>(0.5f);
    return std::bit_cast<std::uint32_t>(
        given->second[std::string_view("xyzw").find(channel.name[dot + 1])]);
  }
};

TEST_P(DocumentedEdges, AreWhatTheCommentsSay) {
  for (const Edge& edge : edges()) {
    const std::vector<float> out = first_output(edge.nodedef, edge.inputs);
    ASSERT_EQ(out.size(), edge.expected.size()) << edge.nodedef << diagnostics_.to_string();
    for (std::size_t i = 0; i < out.size(); ++i) {
      const float expected = edge.expected[i];
      EXPECT_TRUE(std::isnan(expected) ? std::isnan(out[i]) : out[i] == expected)
          << edge.nodedef << '[' << i << "] is " << out[i] << ", not " << expected;
    }
  }
}

/// An axis has a direction however long it is, and a roughness however large ends.
TEST_P(DocumentedEdges, HugeNumbersAreNotLost) {
  for (const float length : {1e-30f, 1e-10f, 1.0f, 1e10f, 1e30f}) {
    const std::vector<float> turned = first_output(
        "ND_rotate3d_vector3", {{"in", {1, 0, 0}}, {"amount", {90}}, {"axis", {0, 0, length}}});
    ASSERT_EQ(turned.size(), 3u) << diagnostics_.to_string();
    EXPECT_NEAR(turned[0], 0.0f, 1e-6f) << length;
    EXPECT_NEAR(turned[1], -1.0f, 1e-6f) << length;
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, DocumentedEdges,
                         ::testing::Values(Backend::jit, Backend::interpreter, Backend::reference),
                         [](const auto& instance) {
                           switch (instance.param) {
                             case Backend::jit: return "jit";
                             case Backend::interpreter: return "interpreter";
                             default: return "reference";
                           }
                         });

}  // namespace
}  // namespace nacre
