#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/jit/shading/engines.h"

namespace nacre {
namespace {

using Numbers = std::map<std::string, float>;

/// Media, displacement and lights, against numbers worked out by hand.
class Shaders : public ::testing::TestWithParam<Backend> {
 protected:
  /// The channels of node n of a document, at one point.
  Numbers evaluate(const std::string& nodes, const Numbers& point = {}) {
    Diagnostics diagnostics;
    const auto system =
        ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
    const auto document = read_document_text(
        "<materialx version=\"1.39\">" + nodes + "</materialx>", "test.mtlx", {}, diagnostics);
    ShaderOptions options;
    options.compile.backend = GetParam();
    const auto kernel = system->compile_outputs(*document, {"n"}, options, diagnostics);
    EXPECT_NE(kernel, nullptr) << diagnostics.to_string();
    if (kernel == nullptr) return {};
    const Program& program = kernel->kernel.program();
    EXPECT_EQ(kernel->outputs.front().channels, program.outputs.size());
    std::vector<const void*> in;
    for (const Channel& channel : program.inputs) in.push_back(&point.at(channel.name));
    std::vector<float> results(program.outputs.size());
    std::vector<void*> out;
    for (float& result : results) out.push_back(&result);
    EXPECT_EQ(kernel->kernel.run(in, out, 1), RunStatus::done);
    Numbers numbers;
    for (std::size_t i = 0; i < results.size(); ++i) {
      numbers[program.outputs[i].name.substr(2)] = results[i];
    }
    return numbers;
  }

  static void expect_vector(const Numbers& numbers, const std::string& name, float x, float y,
                            float z) {
    EXPECT_NEAR(numbers.at(name + ".x"), x, 1e-6f * std::fmax(1.0f, std::fabs(x))) << name;
    EXPECT_NEAR(numbers.at(name + ".y"), y, 1e-6f * std::fmax(1.0f, std::fabs(y))) << name;
    EXPECT_NEAR(numbers.at(name + ".z"), z, 1e-6f * std::fmax(1.0f, std::fabs(z))) << name;
  }
};

std::string vdf(const std::string& name, const std::string& absorption,
                const std::string& scattering, const std::string& anisotropy) {
  return "<anisotropic_vdf name=\"" + name +
         "\" type=\"VDF\"><input name=\"absorption\" "
         "type=\"vector3\" value=\"" +
         absorption +
         "\"/><input name=\"scattering\" type=\"vector3\" "
         "value=\"" +
         scattering + "\"/><input name=\"anisotropy\" type=\"float\" value=\"" + anisotropy +
         "\"/></anisotropic_vdf>";
}

TEST_P(Shaders, MediaAddUp) {
  const Numbers sum =
      evaluate(vdf("a", "1, 2, 3", "3, 3, 3", "0.5") + vdf("b", "0.5, -1, 0", "1, 1, 1", "-0.5") +
               R"(<add name="n" type="VDF"><input name="in1" type="VDF" nodename="a"/>
                                  <input name="in2" type="VDF" nodename="b"/></add>)");
  expect_vector(sum, "absorption", 1.5f, 2, 3);  // Nothing absorbs less than nothing.
  expect_vector(sum, "scattering", 4, 4, 4);
  EXPECT_FLOAT_EQ(sum.at("anisotropy"), 0.25f);  // 9 parts of 0.5, 3 of -0.5.
}

TEST_P(Shaders, MixedMediaKeepTheMeanCosine) {
  const Numbers mixed =
      evaluate(vdf("a", "4, 4, 4", "1, 1, 1", "0.9") + vdf("b", "0, 0, 0", "3, 3, 3", "0.1") +
               R"(<mix name="n" type="VDF"><input name="fg" type="VDF" nodename="a"/>
                                    <input name="bg" type="VDF" nodename="b"/>
                                    <input name="mix" type="float" value="0.25"/></mix>)");
  expect_vector(mixed, "absorption", 1, 1, 1);
  expect_vector(mixed, "scattering", 2.5f, 2.5f, 2.5f);
  EXPECT_NEAR(mixed.at("anisotropy"), (0.25f * 0.9f + 2.25f * 0.1f) / 2.5f, 1e-6f);
}

TEST_P(Shaders, MediaThatDoNotScatterHaveNoDirection) {
  const Numbers sum = evaluate(
      R"(<absorption_vdf name="a" type="VDF"><input name="absorption" type="vector3" value="1, 2, 3"/>
         </absorption_vdf><multiply name="m" type="VDF"><input name="in1" type="VDF" nodename="a"/>
         <input name="in2" type="float" value="-2"/></multiply>
         <add name="n" type="VDF"><input name="in1" type="VDF" nodename="a"/>
         <input name="in2" type="VDF" nodename="m"/></add>)");
  expect_vector(sum, "absorption", 1, 2, 3);
  expect_vector(sum, "scattering", 0, 0, 0);
  EXPECT_EQ(sum.at("anisotropy"), 0);
}

TEST_P(Shaders, AVolumeEmits) {
  const Numbers volume = evaluate(
      vdf("a", "1, 1, 1", "2, 2, 2", "0") +
      R"(<uniform_edf name="e" type="EDF"><input name="color" type="color3" value="3, 2, 1"/></uniform_edf>
         <volume name="n" type="volumeshader"><input name="vdf" type="VDF" nodename="a"/>
         <input name="edf" type="EDF" nodename="e"/></volume>)");
  expect_vector(volume, "absorption", 1, 1, 1);
  expect_vector(volume, "scattering", 2, 2, 2);
  expect_vector(volume, "emission", 3, 2, 1);
}

const Numbers frame{{"T.x", 0}, {"T.y", 0}, {"T.z", -1}, {"B.x", 1}, {"B.y", 0},
                    {"B.z", 0}, {"N.x", 0}, {"N.y", 1},  {"N.z", 0}};

TEST_P(Shaders, DisplacementIsAlongTheNormalOrInTheFrame) {
  expect_vector(evaluate(R"(<displacement name="n" type="displacementshader">
      <input name="displacement" type="float" value="0.5"/><input name="scale" type="float" value="-4"/>
      </displacement>)",
                         frame),
                "offset", 0, -2, 0);
  expect_vector(evaluate(R"(<displacement name="n" type="displacementshader">
      <input name="displacement" type="vector3" value="1, 2, 3"/>
      <input name="scale" type="float" value="10"/></displacement>)",
                         frame),
                "offset", 20, 30, -10);
}

TEST_P(Shaders, DisplacementsMix) {
  expect_vector(evaluate(R"(<displacement name="a" type="displacementshader">
      <input name="displacement" type="float" value="1"/></displacement>
      <mix name="m" type="displacementshader"><input name="fg" type="displacementshader" nodename="a"/>
      <input name="mix" type="float" value="0.25"/></mix>
      <dot name="n" type="displacementshader"><input name="in" type="displacementshader" nodename="m"/>
      </dot>)",
                         frame),
                "offset", 0, 0.25f, 0);
}

/// The channels of an entry point.
std::set<std::string> outputs(const std::optional<BoundKernel>& kernel) {
  std::set<std::string> names;
  if (!kernel) return names;
  for (const Channel& channel : kernel->program().outputs) names.insert(channel.name);
  return names;
}

TEST_P(Shaders, AMaterialHasThemAsKernels) {
  Diagnostics diagnostics;
  const auto system =
      ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
  const auto document = read_document_text(R"(<materialx version="1.39">
      <surface_unlit name="s" type="surfaceshader"/>
      <displacement name="d" type="displacementshader"><input name="displacement" type="float" value="1"/>
      </displacement>
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/>
        <input name="displacementshader" type="displacementshader" nodename="d"/></surfacematerial>
      <absorption_vdf name="a" type="VDF">
        <input name="absorption" type="vector3" value="1, 0, 0"/></absorption_vdf>
      <volume name="v" type="volumeshader"><input name="vdf" type="VDF" nodename="a"/></volume>
      <volumematerial name="V" type="material">
        <input name="volumeshader" type="volumeshader" nodename="v"/></volumematerial>
      </materialx>)",
                                           "test.mtlx", {}, diagnostics);
  ShaderOptions options;
  options.compile.backend = GetParam();
  const auto surface = system->compile_material(*document, "M", options, diagnostics);
  ASSERT_NE(surface, nullptr) << diagnostics.to_string();
  EXPECT_TRUE(surface->emission.has_value());
  EXPECT_EQ(outputs(surface->displacement),
            (std::set<std::string>{"offset.x", "offset.y", "offset.z"}));
  EXPECT_FALSE(surface->volume.has_value());
  const auto volume = system->compile_material(*document, "V", options, diagnostics);
  ASSERT_NE(volume, nullptr) << diagnostics.to_string();
  EXPECT_FALSE(volume->emission.has_value() || volume->begin.has_value());
  EXPECT_EQ(outputs(volume->volume).size(), 10u);
}

const Numbers origin{{"P.x", 0}, {"P.y", 0}, {"P.z", 0}};

// The text of the data library: intensity / (distance + 1)^decay.
TEST_P(Shaders, PointLightsFallOff) {
  const std::string light = R"(<point_light name="n" type="lightshader">
      <input name="position" type="vector3" value="0, 3, 4"/>
      <input name="color" type="color3" value="1, 0.5, 0"/>
      <input name="intensity" type="float" value="72"/></point_light>)";
  const Numbers seen = evaluate(light, origin);
  expect_vector(seen, "intensity", 2, 1, 0);
  expect_vector(seen, "direction", 0, 0.6f, 0.8f);
  EXPECT_FLOAT_EQ(seen.at("distance"), 5);
  const Numbers inside = evaluate(light, {{"P.x", 0}, {"P.y", 3}, {"P.z", 4}});
  expect_vector(inside, "intensity", 72, 36, 0);
  expect_vector(inside, "direction", 0, 0, 0);
}

// One rule: NaN is 0, what overflows is the largest float; directions stay unit wherever the point
// is.
TEST_P(Shaders, EmittedLightIsFinite) {
  constexpr float largest = std::numeric_limits<float>::max();
  const auto point_light = [](const char* position, const char* color, const char* intensity) {
    return std::string(R"(<point_light name="n" type="lightshader">
      <input name="decay_rate" type="float" value="0"/>
      <input name="position" type="vector3" value=")") +
           position + R"("/><input name="color" type="color3" value=")" + color +
           R"("/><input name="intensity" type="float" value=")" + intensity +
           R"("/></point_light>)";
  };
  expect_vector(evaluate(point_light("0, 0, 1", "1e30, -1e30, 0", "1e20"), origin), "intensity",
                largest, -largest, 0);
  for (const char* far : {"0, 3e20, 4e20", "0, 3e-25, 4e-25", "0, 1.5e38, 2e38"}) {
    expect_vector(evaluate(point_light(far, "1, 1, 1", "1"), origin), "direction", 0, 0.6f, 0.8f);
  }
  expect_vector(evaluate(R"(<directional_light name="n" type="lightshader">
      <input name="color" type="color3" value="1e30, -1e30, 0"/>
      <input name="intensity" type="float" value="1e30"/></directional_light>)"),
                "intensity", largest, -largest, 0);
  for (
      const std::string edf :
      {R"(<uniform_edf name="e" type="EDF"><input name="color" type="color3" value="1e30, 2e6, -1"/>
           </uniform_edf>)",
       R"(<conical_edf name="e" type="EDF"><input name="color" type="color3" value="1e30, 2e6, -1"/>
           </conical_edf>)"}) {
    const Numbers facing{{"wo.x", 0}, {"wo.y", 0}, {"wo.z", 1}, {"N.x", 0}, {"N.y", 0}, {"N.z", 1}};
    expect_vector(evaluate(edf + R"(<light name="n" type="lightshader">
        <input name="edf" type="EDF" nodename="e"/><input name="exposure" type="float" value="100"/>
        </light>)",
                           facing),
                  "intensity", largest, std::ldexp(2e6f, 100), 0);
    expect_vector(evaluate(edf + R"(<light name="n" type="lightshader">
        <input name="edf" type="EDF" nodename="e"/></light>)",
                           facing),
                  "intensity", 1e30f, 2e6f, 0);
  }
}

// "Material Nodes" of the specification has it, the data library has not: pbs/library.
TEST_P(Shaders, LightMaterialsAreTheirLight) {
  const auto document_of = [](const std::string& light) {
    return R"(<materialx version="1.39">)" + light + R"(<lightmaterial name="L" type="material">
        <input name="lightshader" type="lightshader" nodename="n"/></lightmaterial></materialx>)";
  };
  Diagnostics diagnostics;
  const auto system =
      ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics);
  ShaderOptions options;
  options.compile.backend = GetParam();
  const auto kernels_of = [&](const std::string& light) {
    const auto document = read_document_text(document_of(light), "test.mtlx", {}, diagnostics);
    return system->compile_material(*document, "L", options, diagnostics);
  };
  const auto lit = kernels_of(R"(<point_light name="n" type="lightshader">
      <input name="position" type="vector3" value="0, 3, 4"/>
      <input name="color" type="color3" value="1, 0.5, 0"/>
      <input name="intensity" type="float" value="72"/></point_light>)");
  ASSERT_NE(lit, nullptr) << diagnostics.to_string();
  EXPECT_EQ(diagnostics.to_string(), "");
  EXPECT_FALSE(lit->has_surface || lit->sample || lit->volume);
  ASSERT_TRUE(lit->light);
  const float zero = 0;
  std::array<float, 7> found{};
  std::vector<const void*> in(lit->light->program().inputs.size(), &zero);
  std::vector<void*> out;
  for (float& one : found) out.push_back(&one);
  ASSERT_EQ(out.size(), lit->light->program().outputs.size());
  EXPECT_EQ(lit->light->run(in, out, 1), RunStatus::done);
  // 72 / (5 + 1)^2 of the colour, from (0, 3, 4) / 5.
  const std::array<float, 7> expected{2, 1, 0, 0, 0.6f, 0.8f, 5};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(found[i], expected[i], 1e-6f) << i;
  const auto dark = kernels_of(R"(<directional_light name="n" type="lightshader">
      <input name="color" type="color3" value="0, 0, 0"/></directional_light>)");
  ASSERT_NE(dark, nullptr);
  EXPECT_FALSE(dark->light);
  ASSERT_EQ(dark->manifest.size(), 1u);
  EXPECT_EQ(dark->manifest.front(), "light: always nothing");
}

TEST_P(Shaders, DirectionalLightsComeFromWhereTheyGo) {
  const Numbers seen = evaluate(R"(<directional_light name="n" type="lightshader">
      <input name="direction" type="vector3" value="0, -1, 0"/>
      <input name="color" type="color3" value="1, 2, 3"/>
      <input name="intensity" type="float" value="2"/></directional_light>)");
  expect_vector(seen, "intensity", 2, 4, 6);
  expect_vector(seen, "direction", 0, 1, 0);
}

TEST_P(Shaders, SpotLightsEndAtTheirCone) {
  const auto at = [&](const std::string& direction, const std::string& outer) {
    return evaluate(R"(<spot_light name="n" type="lightshader">
        <input name="position" type="vector3" value="0, 1, 0"/>
        <input name="direction" type="vector3" value=")" +
                        direction + R"("/>
        <input name="color" type="color3" value="1, 1, 1"/>
        <input name="intensity" type="float" value="4"/>
        <input name="inner_angle" type="float" value="0.9"/>
        <input name="outer_angle" type="float" value=")" +
                        outer + R"("/></spot_light>)",
                    origin)
        .at("intensity.x");
  };
  EXPECT_FLOAT_EQ(at("0, -1, 0", "0.5"), 1);
  EXPECT_FLOAT_EQ(at("0.714142842854285, -0.7, 0", "0.5"), 0.5f);  // Half-way in cosine.
  EXPECT_EQ(at("0.9165151389911680, -0.4, 0", "0.5"), 0);
  EXPECT_EQ(at("0.6, -0.8, 0", "2"), 0);  // No blend: a step at the inner angle.
  EXPECT_FLOAT_EQ(at("0.28, -0.96, 0", "2"), 1);
}

TEST_P(Shaders, AnEmitterHasAnExposure) {
  const Numbers light = evaluate(R"(<uniform_edf name="e" type="EDF">
      <input name="color" type="color3" value="1, 2, 3"/></uniform_edf>
      <light name="n" type="lightshader"><input name="edf" type="EDF" nodename="e"/>
      <input name="intensity" type="float" value="0.5"/><input name="exposure" type="float" value="3"/>
      </light>)");
  expect_vector(light, "intensity", 4, 8, 12);
  EXPECT_FALSE(light.contains("direction.x"));
}

INSTANTIATE_TEST_SUITE_P(Engines, Shaders, all_engines(), engine_name);

}  // namespace
}  // namespace nacre
