// The 2018 names of pbs/library/shaderx.mtlx, against the text that gave them and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/jit/shading/own_library.h"

namespace nacre {
namespace {

using ShaderX = OwnLibrary;

const std::string smooth = value_of("roughness", "vector2", "0, 0");

struct Row {
  const char* node;
  const char* output;
  std::vector<std::array<const char*, 3>> inputs;  ///< Name, type, and the default that it has.
};

/// Sections 4.2 to 4.6 of the text of 2018, port by port; no default where it says none.
const std::vector<Row>& rows() {
  static const std::vector<Row> all{
      {"diffusebrdf",
       "BSDF",
       {{"weight", "float", "1"},
        {"color", "color3", "0.18, 0.18, 0.18"},
        {"roughness", "float", "0"},
        {"normal", "vector3", ""}}},
      {"diffusebtdf",
       "BSDF",
       {{"weight", "float", "1"}, {"color", "color3", "1, 1, 1"}, {"normal", "vector3", ""}}},
      {"conductorbrdf",
       "BSDF",
       {{"weight", "float", "1"},
        {"reflectivity", "color3", "0.8, 0.8, 0.8"},
        {"edgecolor", "color3", "1, 1, 1"},
        {"roughness", "vector2", "0.1, 0.1"},
        {"normal", "vector3", ""},
        {"tangent", "vector3", ""},
        {"distribution", "string", "ggx"}}},
      {"dielectricbrdf",
       "BSDF",
       {{"weight", "float", "1"},
        {"tint", "color3", "1, 1, 1"},
        {"ior", "float", "1.52"},
        {"roughness", "vector2", "0.1, 0.1"},
        {"normal", "vector3", ""},
        {"tangent", "vector3", ""},
        {"distribution", "string", "ggx"},
        {"base", "BSDF", ""}}},
      {"dielectricbtdf",
       "BSDF",
       {{"weight", "float", "1"},
        {"tint", "color3", "1, 1, 1"},
        {"ior", "float", "1.52"},
        {"roughness", "vector2", "0, 0"},
        {"normal", "vector3", ""},
        {"tangent", "vector3", ""},
        {"distribution", "string", "ggx"},
        {"interior", "VDF", ""}}},
      {"subsurfacebrdf",
       "BSDF",
       {{"weight", "float", "1"},
        {"color", "color3", "0.18, 0.18, 0.18"},
        {"radius", "vector3", ""},
        {"anisotropy", "float", ""},
        {"normal", "vector3", ""}}},
      {"sheenbrdf",
       "BSDF",
       {{"weight", "float", "1"},
        {"color", "color3", "1, 1, 1"},
        {"roughness", "float", "0.2"},
        {"normal", "vector3", ""},
        {"base", "BSDF", ""}}},
      {"thinfilmbsdf",
       "BSDF",
       {{"thickness", "float", ""}, {"ior", "float", ""}, {"base", "BSDF", ""}}},
      {"mixbsdf", "BSDF", {{"in1", "BSDF", ""}, {"in2", "BSDF", ""}, {"weight", "float", ""}}},
      {"scalebsdf", "BSDF", {{"in", "BSDF", ""}, {"weight", "color3", ""}}},
      {"uniformedf", "EDF", {{"color", "color3", ""}}},
      {"conicaledf",
       "EDF",
       {{"color", "color3", ""},
        {"normal", "vector3", ""},
        {"inner_angle", "float", "60"},
        {"outer_angle", "float", "0"}}},
      {"measurededf",
       "EDF",
       {{"color", "color3", ""}, {"normal", "vector3", ""}, {"file", "filename", ""}}},
      {"mixedf", "EDF", {{"in1", "EDF", ""}, {"in2", "EDF", ""}, {"weight", "float", ""}}},
      {"scalededf", "EDF", {{"in", "EDF", ""}, {"weight", "color3", ""}}},
      {"absorptionvdf", "VDF", {{"absorption", "color3", ""}}},
      {"anisotropicvdf",
       "VDF",
       {{"absorption", "color3", ""}, {"scattering", "color3", ""}, {"anisotropy", "float", ""}}},
      {"mixvdf", "VDF", {{"in1", "VDF", ""}, {"in2", "VDF", ""}, {"weight", "float", ""}}},
      {"scaledvdf", "VDF", {{"in", "VDF", ""}, {"weight", "color3", ""}}},
      {"surface",
       "surfaceshader",
       {{"bsdf", "BSDF", ""}, {"edf", "EDF", ""}, {"opacity", "float", "1.0"}}},
      {"volume", "volumeshader", {{"vdf", "VDF", ""}, {"edf", "EDF", ""}}},
      {"light",
       "lightshader",
       {{"edf", "EDF", ""}, {"intensity", "color3", "1, 1, 1"}, {"exposure", "float", "0"}}},
      {"displacement",
       "displacementshader",
       {{"displacement", "vector3", ""}, {"scale", "float", ""}}},
      {"mixsurface",
       "surfaceshader",
       {{"in1", "surfaceshader", ""}, {"in2", "surfaceshader", ""}, {"weight", "float", ""}}},
      {"backfacing", "float", {}},
      {"roughness", "vector2", {{"roughness", "float", "0"}, {"anisotropy", "float", "0"}}},
      {"blackbody", "color3", {{"temperature", "float", ""}}},
      {"complexior", "multioutput", {{"ior", "color3", ""}, {"extinction", "color3", ""}}},
  };
  return all;
}

/// Numbers of a list, or the text itself.
std::vector<std::string> parts(std::string text) {
  std::ranges::replace(text, ',', ' ');
  std::istringstream stream(text);
  std::vector<std::string> found;
  for (std::string word; stream >> word;) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    found.push_back(error == std::errc() ? std::to_string(number) : word);
  }
  return found;
}

bool is_input(const NodeDefInput& input, const std::array<const char*, 3>& wanted) {
  if (input.name != wanted[0] || input.type_text != wanted[1]) return false;
  const std::string value(wanted[2]);
  return value.empty() || parts(std::string(input.element->attribute("value"))) == parts(value);
}

bool has_row(const NodeDef& def, const Row& row) {
  const std::string_view output =
      def.outputs.size() > 1 ? "multioutput" : def.outputs.front().type_text;
  return output == row.output && std::ranges::all_of(row.inputs, [&](const auto& wanted) {
           return std::ranges::any_of(
               def.inputs, [&](const NodeDefInput& input) { return is_input(input, wanted); });
         });
}

TEST_F(ShaderX, EveryNodeOfThePageIsThereWithItsPorts) {
  for (const Row& row : rows()) {
    const auto& defs = system_->library().definitions().of_category(row.node);
    EXPECT_TRUE(std::ranges::any_of(defs, [&](const NodeDef* def) { return has_row(*def, row); }))
        << row.node;
  }
}

// 1 / (n + 1)^2 + k^2 ..., whatever way through the two colours.
TEST_F(ShaderX, AMetalOfAComplexIndexReflectsWhatFresnelSays) {
  const std::string metal =
      node("complexior", "multioutput", "c",
           value_of("ior", "color3", "0.2, 0.9, 1.4") +
               value_of("extinction", "color3", "3.4, 2.3, 7.7")) +
      node("conductorbrdf", "BSDF", "b",
           R"(<input name="reflectivity" type="color3" nodename="c" output="reflectivity"/>
              <input name="edgecolor" type="color3" nodename="c" output="edgecolor"/>)" +
               smooth);
  const auto fresnel = [](double n, double k, double c) {
    // Exact: Born and Wolf, 14.2.1, through complex cosines.
    const double s2 = 1 - c * c;
    const double d = n * n - k * k - s2;
    const double a2b2 = std::sqrt(d * d + 4 * n * n * k * k);
    const double a = std::sqrt(0.5 * (a2b2 + d));
    const double rs = (a2b2 - 2 * a * c + c * c) / (a2b2 + 2 * a * c + c * c);
    const double rp =
        rs * (a2b2 * c * c - 2 * a * c * s2 + s2 * s2) / (a2b2 * c * c + 2 * a * c * s2 + s2 * s2);
    return static_cast<float>(0.5 * (rs + rp));
  };
  for (const float c : {1.0f, 0.5f, 0.1f}) {
    expect_colour(albedo(metal, c),
                  {fresnel(0.2, 3.4, c), fresnel(0.9, 2.3, c), fresnel(1.4, 7.7, c)}, 2e-5f);
  }
}

TEST_F(ShaderX, AnIndexWithoutAbsorptionHasNoEdge) {
  const auto colour = [&](const std::string& output) {
    return value(
        node("complexior", "multioutput", "c",
             value_of("ior", "color3", "1.5, 1, 4") + value_of("extinction", "color3", "0, 0, 0")) +
        node("dot", "color3", "n",
             "<input name=\"in\" type=\"color3\" nodename=\"c\" output=\"" + output + "\"/>"));
  };
  const Numbers reflectivity = colour("reflectivity");
  EXPECT_NEAR(reflectivity.at("x"), 0.04f, 1e-6f);
  EXPECT_EQ(reflectivity.at("y"), 0.0f);
  EXPECT_NEAR(reflectivity.at("z"), 0.36f, 1e-6f);
  const Numbers edge = colour("edgecolor");
  EXPECT_NEAR(edge.at("x"), 0.0f, 1e-5f);
  EXPECT_NEAR(edge.at("z"), 0.0f, 1e-5f);
}

// "If set to 0.0 the Fresnel curve is disabled and reflectivity is controlled only by weight and
// tint"; what it leaves is the base's.
TEST_F(ShaderX, ADielectricWithoutAnIndexReflectsItsTint) {
  const std::string top = value_of("ior", "float", "0") + value_of("weight", "float", "0.5") +
                          value_of("tint", "color3", "0.8, 0.4, 0") + smooth;
  for (const float c : {1.0f, 0.3f}) {
    expect_colour(albedo(node("dielectricbrdf", "BSDF", "b", top), c), {0.4f, 0.2f, 0.0f}, 1e-6f);
    expect_colour(
        albedo(node("diffusebrdf", "BSDF", "d", value_of("color", "color3", "0.5, 0.5, 0.5")) +
                   node("dielectricbrdf", "BSDF", "b", top + from("base", "BSDF", "d")),
               c),
        {0.4f + 0.6f * 0.5f, 0.2f + 0.8f * 0.5f, 0.5f}, 1e-6f);
  }
}

TEST_F(ShaderX, ADielectricOverABase) {
  const std::string glossy =
      node("diffusebrdf", "BSDF", "d", value_of("color", "color3", "1, 0.5, 0")) +
      node("dielectricbrdf", "BSDF", "b", smooth + from("base", "BSDF", "d"));
  const float f = std::pow(0.52f / 2.52f, 2.0f);
  expect_colour(albedo(glossy), {1.0f, f + (1 - f) * 0.5f, f}, 1e-6f);
}

TEST_F(ShaderX, WeightsOfMixturesAreThoseOfTheSecond) {
  const std::string two = node("diffusebrdf", "BSDF", "x", value_of("color", "color3", "1, 0, 0")) +
                          node("diffusebrdf", "BSDF", "y", value_of("color", "color3", "0, 1, 0"));
  const std::string weight = value_of("weight", "float", "0.25");
  expect_colour(albedo(two + node("mixbsdf", "BSDF", "b",
                                  from("in1", "BSDF", "x") + from("in2", "BSDF", "y") + weight)),
                {0.75f, 0.25f, 0.0f}, 1e-6f);
  const Numbers light =
      value(node("uniformedf", "EDF", "x", value_of("color", "color3", "1, 2, 3")) +
            node("uniformedf", "EDF", "y", value_of("color", "color3", "5, 2, 3")) +
            node("mixedf", "EDF", "m", from("in1", "EDF", "x") + from("in2", "EDF", "y") + weight) +
            node("scalededf", "EDF", "e",
                 from("in", "EDF", "m") + value_of("weight", "color3", "1, 10, 0.5")) +
            node("light", "lightshader", "n",
                 from("edf", "EDF", "e") + value_of("intensity", "color3", "1, 1, 2") +
                     value_of("exposure", "float", "2")));
  EXPECT_FLOAT_EQ(light.at("intensity.x"), 4 * 2.0f);
  EXPECT_FLOAT_EQ(light.at("intensity.y"), 4 * 20.0f);
  EXPECT_FLOAT_EQ(light.at("intensity.z"), 4 * 3.0f);
  const Numbers medium =
      value(node("absorptionvdf", "VDF", "x", value_of("absorption", "color3", "4, 0, 0")) +
            node("anisotropicvdf", "VDF", "y",
                 value_of("absorption", "color3", "0, 4, 0") +
                     value_of("scattering", "color3", "8, 8, 8") +
                     value_of("anisotropy", "float", "0.5")) +
            node("mixvdf", "VDF", "m", from("in1", "VDF", "x") + from("in2", "VDF", "y") + weight) +
            node("scaledvdf", "VDF", "v",
                 from("in", "VDF", "m") + value_of("weight", "color3", "1, 2, 3")) +
            node("volume", "volumeshader", "n", from("vdf", "VDF", "v")));
  EXPECT_FLOAT_EQ(medium.at("absorption.x"), 3.0f);
  EXPECT_FLOAT_EQ(medium.at("absorption.y"), 2.0f);
  EXPECT_FLOAT_EQ(medium.at("scattering.z"), 6.0f);
  EXPECT_FLOAT_EQ(medium.at("anisotropy"), 0.5f);
}

// "The scaling weight is normalized to hold maximum 1.0 in any channel."
TEST_F(ShaderX, AScaleAddsNoLight) {
  const std::string white =
      node("diffusebrdf", "BSDF", "x", value_of("color", "color3", "1, 1, 1"));
  const auto scaled = [&](const std::string& weight) {
    return albedo(white + node("scalebsdf", "BSDF", "b",
                               from("in", "BSDF", "x") + value_of("weight", "color3", weight)));
  };
  expect_colour(scaled("4, 1, 2"), {1.0f, 0.25f, 0.5f}, 1e-6f);
  expect_colour(scaled("0.5, 0, 0.25"), {0.5f, 0.0f, 0.25f}, 1e-6f);
}

TEST_F(ShaderX, RoughnessIsSquared) {
  const Numbers same =
      value(node("roughness", "vector2", "n", value_of("roughness", "float", "0.5")));
  EXPECT_FLOAT_EQ(same.at("x"), 0.25f);
  EXPECT_FLOAT_EQ(same.at("y"), 0.25f);
}

TEST_F(ShaderX, BackFacesAreSeenFromBehind) {
  const std::string back = node("backfacing", "float", "n", "");
  EXPECT_EQ(value(back, {{"wo.x", 0.6f}, {"wo.z", 0.8f}}).begin()->second, 0.0f);
  EXPECT_EQ(value(back, {{"wo.x", 0.6f}, {"wo.z", -0.8f}}).begin()->second, 1.0f);
}

// The film of today's closures, and of nothing that lies below.
TEST_F(ShaderX, AFilmIsThatOfTheClosureBelow) {
  const std::string film = value_of("thickness", "float", "400") + value_of("ior", "float", "1.3") +
                           from("base", "BSDF", "x");
  const std::string thin =
      value_of("thinfilm_thickness", "float", "400") + value_of("thinfilm_ior", "float", "1.3");
  const std::string index =
      value_of("ior", "float", "1.7") + value_of("roughness", "vector2", "0.2, 0.2");
  const std::string diffuse =
      node("diffusebrdf", "BSDF", "d", value_of("color", "color3", "0, 1, 0"));
  for (const float c : {1.0f, 0.4f}) {
    const Colour today =
        albedo(diffuse + node("dielectric_bsdf", "BSDF", "x", index + thin) +
                   node("layer", "BSDF", "b", from("top", "BSDF", "x") + from("base", "BSDF", "d")),
               c);
    const Colour then =
        albedo(diffuse + node("dielectricbrdf", "BSDF", "x", index + from("base", "BSDF", "d")) +
                   node("thinfilmbsdf", "BSDF", "b", film),
               c);
    EXPECT_EQ(then, today);
    const Colour bare =
        albedo(diffuse + node("dielectricbrdf", "BSDF", "b", index + from("base", "BSDF", "d")), c);
    EXPECT_NE(then, bare);
    EXPECT_EQ(
        albedo(node("conductor_bsdf", "BSDF", "x", "") + node("thinfilmbsdf", "BSDF", "b", film),
               c),
        albedo(node("conductor_bsdf", "BSDF", "b", thin), c));
    EXPECT_EQ(albedo(node("dielectric_bsdf", "BSDF", "x",
                          index + value_of("scatter_mode", "string", "RT")) +
                         node("thinfilmbsdf", "BSDF", "b", film),
                     c),
              albedo(node("dielectric_bsdf", "BSDF", "b",
                          index + thin + value_of("scatter_mode", "string", "RT")),
                     c));
  }
}

// An interface of index 1 is nothing, and a film on it is not.
TEST_F(ShaderX, AFilmOnAnInterfaceOfNoIndexIsSeen) {
  const std::string index =
      value_of("ior", "float", "1") + value_of("roughness", "vector2", "0, 0");
  const Colour today = albedo(node("dielectric_bsdf", "BSDF", "b",
                                   index + value_of("thinfilm_thickness", "float", "400") +
                                       value_of("thinfilm_ior", "float", "1.5")),
                              0.5f);
  EXPECT_GT(today[0], 0.01f);
  EXPECT_EQ(albedo(node("dielectric_bsdf", "BSDF", "x", index) +
                       node("thinfilmbsdf", "BSDF", "b",
                            value_of("thickness", "float", "400") +
                                value_of("ior", "float", "1.5") + from("base", "BSDF", "x")),
                   0.5f),
            today);
}

TEST_F(ShaderX, AFilmOverNothingThatHasFacetsIsSaid) {
  const auto kernels = material(node("diffusebrdf", "BSDF", "x", "") +
                                node("thinfilmbsdf", "BSDF", "b", from("base", "BSDF", "x")));
  ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
  EXPECT_TRUE(std::ranges::any_of(kernels->manifest, [](const std::string& line) {
    return line.starts_with("thinfilmbsdf:");
  }));
}

TEST_F(ShaderX, AFilmOverADeepChain) {
  std::string nodes = node("dielectricbrdf", "BSDF", "x0", "");
  for (int i = 1; i <= 500; ++i) {
    const std::string before = "x" + std::to_string(i - 1);
    nodes += node("mixbsdf", "BSDF", "x" + std::to_string(i),
                  from("in1", "BSDF", before) + from("in2", "BSDF", before) +
                      value_of("weight", "float", "0.5"));
  }
  const auto kernels =
      material(nodes + node("thinfilmbsdf", "BSDF", "b", from("base", "BSDF", "x500")));
  ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
  EXPECT_EQ(kernels->lobes.size(), 1u);
}

// As files of that year write it: parameters, and no version that has today's nodes.
TEST_F(ShaderX, ADocumentOfThatYear) {
  const auto document = read_document_text(R"(<materialx version="1.36">
      <nodegraph name="NG_gold" nodedef="ND_gold">
        <roughness name="r" type="vector2"><input name="roughness" type="float" value="0.3"/></roughness>
        <conductorbrdf name="metal" type="BSDF">
          <input name="reflectivity" type="color3" value="1.0, 0.8, 0.4"/>
          <input name="roughness" type="vector2" nodename="r"/>
          <parameter name="distribution" type="string" value="ggx"/></conductorbrdf>
        <surface name="shader" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="metal"/></surface>
        <output name="out" type="surfaceshader" nodename="shader"/>
      </nodegraph>
      <nodedef name="ND_gold" node="gold" type="surfaceshader"/>
      <material name="M"><shaderref name="shader" node="gold"/></material>
    </materialx>)",
                                           "old.mtlx", {}, diagnostics_);
  ASSERT_NE(document, nullptr) << diagnostics_.to_string();
  const auto kernels = system_->compile_material(*document, "M", options_, diagnostics_);
  ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
  EXPECT_EQ(kernels->lobes.size(), 1u);
  EXPECT_EQ(diagnostics_.to_string(), "");
}

}  // namespace
}  // namespace nacre
