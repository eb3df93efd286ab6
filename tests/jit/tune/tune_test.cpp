// What is chosen keeps its error at other points, against computations that tune() does not do.
#include "jit/tune/tune.h"

#include <gtest/gtest.h>

#include <cmath>

#include "jit/tune/dimension.h"
#include "tests/jit/tune/documents.h"
#include "tests/support/material_text.h"

namespace nacre {
namespace {

/// An output "out" of one node with one input.
std::string function_of_s(const std::string& node, const std::string& input) {
  return R"(<materialx version="1.39"><texcoord name="uv" type="vector2"/>
    <extract name="s" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
    <)" + node +
         R"( name="f" type="float"><input name=")" + input + R"(" type="float" nodename="s"/></)" +
         node + R"(>
    <output name="out" type="float" nodename="f"/></materialx>)";
}

const char* const white_metal = R"(<conductor_bsdf name="b" type="BSDF">
  <input name="ior" type="color3" value="0, 0, 0"/>
  <input name="extinction" type="color3" value="1, 1, 1"/>
  <input name="roughness" type="vector2" value="1, 1"/></conductor_bsdf>)";

std::optional<Tuned> tuned(const std::string& text, double max_error, bool is_material,
                           Diagnostics& diagnostics) {
  const auto document = document_of(text);
  TuneOptions options;
  options.max_error = max_error;
  options.seconds_a_kernel = 0;
  return tune({&tune_system(), document.get(), {is_material ? "M" : "out"}, is_material}, options,
              diagnostics);
}

std::string setting(const Candidate& candidate, std::string_view dimension) {
  const auto all = dimensions();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name == dimension) return std::string(all[i].settings[candidate.choices[i]]);
  }
  return "";
}

TEST(Tune, KeepsItsErrorAgainstTheCLibrary) {
  for (const double max_error : {1e-2, 1e-5, 1e-6}) {
    Diagnostics diagnostics;
    const std::string text = function_of_s("exp", "in");
    const auto found = tuned(text, max_error, false, diagnostics);
    ASSERT_TRUE(found) << diagnostics.to_string();
    ShaderOptions options;
    apply_choices(found->chosen.choices, options);
    const auto document = document_of(text);
    const auto kernel = tune_system().compile_outputs(*document, {"out"}, options, diagnostics);
    ASSERT_NE(kernel, nullptr) << diagnostics.to_string();
    for (int i = 0; i <= 1000; ++i) {
      const float s = static_cast<float>(i) * 1e-3f, t = 0;
      float out = 0;
      const void* inputs[]{&s, &t};
      void* outputs[]{&out};
      const std::size_t count = kernel->kernel.program().inputs.size();
      ASSERT_EQ(kernel->kernel.run(std::span(inputs, count), outputs, 1), RunStatus::done);
      EXPECT_NEAR(out / std::exp(double(s)), 1, 3 * max_error);
    }
  }
}

TEST(Tune, WhatIsAskedForIsKeptAtPointsThatWereNotSeen) {
  for (const double max_error : {1e-1, 1e-3, 1e-5}) {
    Diagnostics diagnostics;
    const auto found = tuned(material_of(white_metal), max_error, true, diagnostics);
    ASSERT_TRUE(found) << diagnostics.to_string();
    EXPECT_LE(found->chosen.unseen_error->p999, max_error);
    EXPECT_LE(found->chosen.unseen_error->maximum, 3 * max_error);
    EXPECT_LE(found->chosen.cost, found->front.front().cost);
  }
}

// White metal of alpha 1 sends 1 - ln 2 = .307 of the light astray at the first facet, seen from
// above (integral of Smith's visible normals); f lacks a part of itself, so that no number is off
// by more than all of it.
TEST(Tune, LeavesOutWhatAnErrorAllows) {
  Diagnostics diagnostics;
  const auto coarse = tuned(material_of(white_metal), 1, true, diagnostics);
  const auto fine = tuned(material_of(white_metal), 0.01, true, diagnostics);
  ASSERT_TRUE(coarse && fine) << diagnostics.to_string();
  EXPECT_EQ(setting(coarse->chosen, "compensation"), "nothing");
  EXPECT_NE(setting(fine->chosen, "compensation"), "nothing");
  EXPECT_LT(coarse->chosen.cost, fine->chosen.cost);
}

// Stripes across s, 16 texels to a period, under footprints of every length and direction: a
// blur as wide as the longer side of them is far from their mean along it, of which whoever looks
// once at each knows nothing.
TEST(Tune, SlantedFootprintsNeedTheirAnisotropy) {
  Pixels stripes{.width = 256, .height = 256, .channels = 1, .samples = SampleType::floating};
  std::vector<float> texels(256 * 256);
  for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = i % 16 < 8 ? 0.0f : 1.0f;
  stripes.data = texels.data();
  Diagnostics diagnostics;
  ASSERT_TRUE(tune_system().textures().set_image("stripes", stripes, diagnostics));
  const std::string image = R"(<materialx version="1.39"><image name="i" type="float">
    <input name="file" type="filename" value="stripes"/></image>
    <output name="out" type="float" nodename="i"/></materialx>)";
  const auto fine = tuned(image, 1e-3, false, diagnostics);
  const auto coarse = tuned(image, 100, false, diagnostics);
  ASSERT_TRUE(fine && coarse) << diagnostics.to_string();
  EXPECT_NE(setting(fine->chosen, "anisotropy"), "1");
  EXPECT_EQ(setting(fine->chosen, "footprints"), "yes");
  EXPECT_EQ(setting(coarse->chosen, "footprints"), "no");
}

// Grain of cells that footprints cover, a hundredth of what it lies on: it is worth its octaves
// only where an error is smaller than that.
TEST(Tune, NoiseThatFootprintsCoverGoesWhereAnErrorAllows) {
  const std::string grain = R"(<materialx version="1.39"><texcoord name="uv" type="vector2"/>
    <multiply name="at" type="vector2"><input name="in1" type="vector2" nodename="uv"/>
      <input name="in2" type="float" value="300"/></multiply>
    <fractal2d name="f" type="float"><input name="texcoord" type="vector2" nodename="at"/>
      <input name="amplitude" type="float" value="0.005"/>
      <input name="octaves" type="integer" value="5"/></fractal2d>
    <add name="a" type="float"><input name="in1" type="float" nodename="f"/>
      <input name="in2" type="float" value="0.5"/></add>
    <output name="out" type="float" nodename="a"/></materialx>)";
  Diagnostics diagnostics;
  const auto fine = tuned(grain, 1e-4, false, diagnostics);
  const auto coarse = tuned(grain, 0.03, false, diagnostics);
  ASSERT_TRUE(fine && coarse) << diagnostics.to_string();
  EXPECT_EQ(setting(fine->chosen, "noise"), "all");
  EXPECT_EQ(setting(coarse->chosen, "noise"), "resolved");
  EXPECT_LT(coarse->chosen.cost, 0.7 * fine->chosen.cost);
}

TEST(Tune, TheFrontFallsInCostAndRisesInError) {
  Diagnostics diagnostics;
  const auto found = tuned(material_of(white_metal), 0.01, true, diagnostics);
  ASSERT_TRUE(found) << diagnostics.to_string();
  ASSERT_GE(found->front.size(), 2u);
  for (std::size_t i = 1; i < found->front.size(); ++i) {
    EXPECT_LT(found->front[i].cost, found->front[i - 1].cost);
    EXPECT_GT(found->front[i].error.p999, found->front[i - 1].error.p999);
  }
}

TEST(Tune, IsTheSameEveryTime) {
  Diagnostics diagnostics;
  const auto once = tuned(material_of(white_metal), 0.01, true, diagnostics);
  const auto again = tuned(material_of(white_metal), 0.01, true, diagnostics);
  ASSERT_TRUE(once && again) << diagnostics.to_string();
  EXPECT_EQ(once->chosen.choices, again->chosen.choices);
  EXPECT_EQ(once->chosen.error.p999, again->chosen.error.p999);
  EXPECT_EQ(once->chosen.cost, again->chosen.cost);
}

TEST(Tune, SaysThatNothingIsSoExact) {
  Diagnostics diagnostics;
  EXPECT_FALSE(tuned(function_of_s("exp", "in"), 1e-12, false, diagnostics));
  ASSERT_EQ(diagnostics.error_count(), 1u) << diagnostics.to_string();
  EXPECT_EQ(diagnostics.all()[0].code, "no-such-error");
}

TEST(Tune, WhatCannotBeCompiledIsSaidOnce) {
  Diagnostics diagnostics;
  const auto document = document_of(R"(<materialx version="1.39"/>)");
  EXPECT_FALSE(tune({&tune_system(), document.get(), {"M"}, true}, {}, diagnostics));
  EXPECT_EQ(diagnostics.error_count(), 1u) << diagnostics.to_string();
}

}  // namespace
}  // namespace nacre
