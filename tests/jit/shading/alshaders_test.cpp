// The shaders of pbs/library/alshaders.mtlx, against what their paper says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/jit/shading/own_library.h"

namespace nacre {
namespace {

class AlShaders : public OwnLibrary {
 protected:
  std::unique_ptr<MaterialKernels> shader(const std::string& inputs,
                                          const std::string& category = "alSurface") {
    const auto document = read(node(category, "surfaceshader", "s", inputs) + R"(
      <surfacematerial name="M" type="material">
        <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>)");
    if (document == nullptr) return nullptr;
    return system_->compile_material(*document, "M", options_, diagnostics_);
  }

  static Numbers view(float cosine) {
    return {{"wo.x", std::sqrt(1.0f - cosine * cosine)}, {"wo.y", 0.0f}, {"wo.z", cosine}};
  }

  Colour light_of(const std::string& inputs, float cosine = 1.0f,
                  const std::string& category = "alSurface") {
    const auto kernels = shader(inputs, category);
    if (kernels == nullptr) return ADD_FAILURE() << diagnostics_.to_string(), Colour();
    const Numbers all = run(*kernels->albedo, view(cosine));
    return {all.at("albedo.x"), all.at("albedo.y"), all.at("albedo.z")};
  }

  /// f cos of a material that is seen along the normal, by light from (x, y).
  float scattered(const MaterialKernels& kernels, float x, float y) {
    Numbers point = view(1.0f);
    if (kernels.begin) {
      for (const auto& [name, number] : run(*kernels.begin, point)) point[name] = number;
    }
    point["wi.x"] = x;
    point["wi.y"] = y;
    point["wi.z"] = std::sqrt(1.0f - x * x - y * y);
    return run(*kernels.evaluate, point).at("f.x");
  }
};

const std::string white = value_of("diffuseColor", "color3", "1, 1, 1");
const std::string no_specular = value_of("specular1Strength", "float", "0");

// Figure 10: "If all layers are pure white, the shader will reflect 100% of the energy it
// receives."
TEST_F(AlShaders, WhiteLayersReflectAllLight) {
  for (const char* const strength : {"0", "0.5", "1"}) {
    const std::string two = white + value_of("specular2Strength", "float", strength) +
                            value_of("specular2Ior", "float", "1.8") +
                            value_of("specular1Roughness", "float", "0.7");
    for (const float c : {1.0f, 0.4f, 0.05f}) expect_colour(light_of(two, c), {1, 1, 1}, 1e-5f);
  }
  expect_colour(light_of(value_of("transmissionStrength", "float", "1") +
                         value_of("specular1Roughness", "float", "0")),
                {1, 1, 1}, 1e-5f);
}

// 5.5: "specifying a high IOR (e.g., 10-1000) and selecting a specular color multiplier"; Fresnel
// at normal incidence.
TEST_F(AlShaders, MetalsAreHighIndicesWithAColour) {
  const std::string metal = value_of("diffuseStrength", "float", "0") +
                            value_of("specular1Roughness", "float", "0") +
                            value_of("specular1Color", "color3", "1, 0.5, 0.25");
  for (const float ior : {10.0f, 49.0f, 51.0f, 1000.0f}) {
    const float f = std::pow((ior - 1) / (ior + 1), 2.0f);
    expect_colour(light_of(metal + value_of("specular1Ior", "float", std::to_string(ior))),
                  {f, 0.5f * f, 0.25f * f}, 1e-5f);
  }
}

// 5.2: "values less than 0.5 stretch in the U direction, and values greater than 0.5 stretch in the
// V direction", and the frame turns.
TEST_F(AlShaders, AnisotropyStretchesHighlights) {
  const auto along_u = [&](const std::string& anisotropy, const std::string& rotation) {
    const auto kernels = shader(value_of("diffuseStrength", "float", "0") +
                                value_of("specular1Anisotropy", "float", anisotropy) +
                                value_of("specular1Rotation", "float", rotation));
    if (kernels == nullptr) return ADD_FAILURE() << diagnostics_.to_string(), 0.0f;
    return scattered(*kernels, 0.3f, 0.0f) / scattered(*kernels, 0.0f, 0.3f);
  };
  EXPECT_NEAR(along_u("0.5", "0"), 1.0f, 1e-4f);
  EXPECT_GT(along_u("0.2", "0"), 2.0f);
  EXPECT_LT(along_u("0.8", "0"), 0.5f);
  EXPECT_NEAR(along_u("0.8", "0.25"), along_u("0.2", "0"), 1e-2f * along_u("0.2", "0"));
}

// 5.2: Beckmann's facets, whose roughness is the square of the parameter: for a mirror direction
// the highlight is F D / 4 with D = 1 / (pi alpha^2), and falls off as a normal distribution of
// slopes.
TEST_F(AlShaders, HighlightsAreBeckmanns) {
  const auto kernels = shader(value_of("diffuseStrength", "float", "0") +
                              value_of("specular1Roughness", "float", "0.4"));
  ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
  const double alpha = 0.16, f0 = std::pow(0.4 / 2.4, 2);
  EXPECT_NEAR(scattered(*kernels, 0, 0), f0 / (4 * 3.14159265 * alpha * alpha), 1e-2 * 0.35);
  // Half-way vector of a light at angle t: slope tan(t / 2).
  const double t = 0.5, slope = std::tan(t / 2);
  const double d = std::exp(-slope * slope / (alpha * alpha)) / std::pow(std::cos(t / 2), 4);
  const double ratio =
      scattered(*kernels, static_cast<float>(std::sin(t)), 0) / scattered(*kernels, 0, 0);
  // Masking and Fresnel change little at that angle.
  EXPECT_NEAR(ratio / d, 1.0, 3e-2);
}

// 5.1: "blended with Weight parameters, which are normalized before being used"; "the final albedo
// can be user controlled ... by the Diffuse Color parameter".
TEST_F(AlShaders, ScatteringKeepsTheDiffuseColour) {
  const std::string scattering = no_specular + value_of("sssMix", "float", "1") +
                                 value_of("diffuseColor", "color3", "0.8, 0.4, 0.2");
  for (const char* const weight : {"0.5", "7"}) {
    expect_colour(
        light_of(scattering + value_of("sssWeight1", "float", weight) +
                 value_of("sssWeight2", "float", weight) + value_of("sssWeight3", "float", weight)),
        {0.8f, 0.4f, 0.2f}, 1e-6f);
  }
}

TEST_F(AlShaders, AttenuationIsSaidToBeTheRenderers) {
  const auto kernels = shader(value_of("transmissionStrength", "float", "1") +
                              value_of("ssAttenuationColor", "color3", "0.9, 0.5, 0.5"));
  ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
  EXPECT_TRUE(std::ranges::any_of(kernels->manifest, [](const std::string& line) {
    return line.starts_with("interior medium: absorption");
  }));
}

TEST_F(AlShaders, Emits) {
  const auto kernels = shader(value_of("emissionStrength", "float", "2") +
                              value_of("emissionColor", "color3", "1, 0.5, 0"));
  ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
  const Numbers light = run(*kernels->emission, view(0.5f));
  EXPECT_FLOAT_EQ(light.at("emission.x"), 2.0f);
  EXPECT_FLOAT_EQ(light.at("emission.y"), 1.0f);
  EXPECT_EQ(light.at("emission.z"), 0.0f);
}

// Chiang et al. 2016: a fibre that absorbs nothing scatters all light.
TEST_F(AlShaders, WhiteHairLosesNothing) {
  for (const float c : {1.0f, 0.5f}) {
    expect_colour(light_of(value_of("melanin", "float", "0"), c, "alHair"), {1, 1, 1}, 2e-3f);
  }
  const Colour brown = light_of(value_of("melanin", "float", "0.5"), 1.0f, "alHair");
  EXPECT_GT(brown[0], brown[2]);
  EXPECT_LT(brown[0], 0.9f);
}

TEST_F(AlShaders, ALayerIsMixed) {
  const auto document =
      read(node("alSurface", "surfaceshader", "x",
                no_specular + value_of("diffuseColor", "color3", "1, 0, 0")) +
           node("alSurface", "surfaceshader", "y",
                no_specular + value_of("diffuseColor", "color3", "0, 1, 0")) +
           node("alLayer", "surfaceshader", "s",
                from("layer1", "surfaceshader", "x") + from("layer2", "surfaceshader", "y") +
                    value_of("mix", "float", "0.25")) +
           R"(<surfacematerial name="M" type="material">
         <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>)");
  ASSERT_NE(document, nullptr) << diagnostics_.to_string();
  const auto kernels = system_->compile_material(*document, "M", options_, diagnostics_);
  ASSERT_NE(kernels, nullptr) << diagnostics_.to_string();
  const Numbers light = run(*kernels->albedo, view(1.0f));
  EXPECT_NEAR(light.at("albedo.x"), 0.75f, 1e-6f);
  EXPECT_NEAR(light.at("albedo.y"), 0.25f, 1e-6f);
}

TEST_F(AlShaders, NumbersAreRemapped) {
  const auto remapped = [&](const std::string& more) {
    return value(node("alRemapFloat", "float", "n", value_of("input", "float", "3") + more))
        .begin()
        ->second;
  };
  EXPECT_FLOAT_EQ(remapped(""), 3.0f);
  const std::string range =
      value_of("RMPinputMin", "float", "1") + value_of("RMPinputMax", "float", "5") +
      value_of("RMPoutputMin", "float", "10") + value_of("RMPoutputMax", "float", "20");
  EXPECT_FLOAT_EQ(remapped(range), 15.0f);
  EXPECT_FLOAT_EQ(remapped(range + value_of("RMPcontrast", "float", "2") +
                           value_of("RMPcontrastPivot", "float", "0.25")),
                  10.0f + 10.0f * 0.75f);
  const std::string limit = value_of("RMPclampEnable", "boolean", "true");
  EXPECT_FLOAT_EQ(remapped(limit), 1.0f);
}

TEST_F(AlShaders, ValuesAreCombinedAndChosen) {
  const float expected[] = {6.0f, 5.0f, 1.5f, 1.0f, 2.75f};
  for (int op = 0; op < 5; ++op) {
    const Numbers out =
        value(node("alCombineFloat", "float", "n",
                   value_of("input1", "float", "3") + value_of("input2", "float", "2") +
                       value_of("input3", "float", "0.25") +
                       value_of("combineOp", "integer", std::to_string(op))));
    EXPECT_FLOAT_EQ(out.begin()->second, expected[op]) << op;
  }
  const Numbers chosen =
      value(node("alSwitchColor", "color3", "n",
                 value_of("inputC", "color3", "1, 2, 3") + value_of("mix", "integer", "2")));
  EXPECT_FLOAT_EQ(chosen.at("z"), 3.0f);
  EXPECT_FLOAT_EQ(
      value(node("alCacheFloat", "float", "n", value_of("input", "float", "7"))).begin()->second,
      7.0f);
}

TEST_F(AlShaders, ColoursAreGraded) {
  const auto graded = [&](const std::string& more) {
    return value(
        node("alRemapColor", "color3", "n", value_of("input", "color3", "0.25, 0.5, 1") + more));
  };
  EXPECT_NEAR(graded("").at("x"), 0.25f, 1e-6f);
  const Numbers brighter =
      graded(value_of("gamma", "float", "2") + value_of("exposure", "float", "1"));
  EXPECT_NEAR(brighter.at("x"), 1.0f, 1e-5f);  // sqrt(0.25) * 2
  EXPECT_NEAR(brighter.at("z"), 2.0f, 1e-5f);
  const Numbers grey = graded(value_of("saturation", "float", "0"));
  EXPECT_NEAR(grey.at("x"), grey.at("z"), 1e-6f);
  EXPECT_NEAR(graded(value_of("exposure", "float", "3") + value_of("mask", "float", "0")).at("y"),
              0.5f, 1e-6f);
}

TEST_F(AlShaders, PatternsLieBetweenTheirColours) {
  const std::string colours =
      value_of("color1", "color3", "0, 0, 5") + value_of("color2", "color3", "1, 0, 5");
  float least = 1e9f, most = -1e9f;
  for (int i = 0; i < 200; ++i) {
    const float at = 0.37f * static_cast<float>(i);
    const Numbers point{{"Po.x", at}, {"Po.y", 0.5f * at}, {"Po.z", 1.0f - at}};
    const Numbers noise = value(node("alFractal", "color3", "n", colours), point);
    least = std::fmin(least, noise.at("x"));
    most = std::fmax(most, noise.at("x"));
    EXPECT_EQ(noise.at("z"), 5.0f);
    if (i % 10 == 0) {
      EXPECT_GE(value(node("alCellNoise", "color3", "n", colours), point).at("x"), 0.0f);
    }
  }
  EXPECT_LT(least, 0.4f);
  EXPECT_GT(most, 0.6f);
}

}  // namespace
}  // namespace nacre
