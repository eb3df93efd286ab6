// RenderMan's developer page about RixBxdf, point by point: what a renderer that is written for it
// asks, and what Nacre gives. jit/api/RIXBXDF.md has the table; transport and lobes have files of
// their own.
#include "tests/jit/api/rix_bxdf.h"

#include <algorithm>
#include <thread>

namespace nacre {
namespace {

const std::string lambert =
    lobe("oren_nayar_diffuse_bsdf", given("color", "color3", "0.8, 0.4, 0.2"));
const std::string glass =
    lobe("dielectric_bsdf", given("scatter_mode", "string", "RT") + facets("0.3"));

bool reads(const Shader& shader, nacre_entry entry, const std::string& group) {
  const std::vector<Channel> inputs = shader.inputs(entry);
  return std::ranges::any_of(
      inputs, [&](const Channel& input) { return input.name.starts_with(group + "."); });
}

// "RixBxdfFactory::BeginScatter() to obtain a RixBxdf, parameterized by the bxdf's potentially
// varying input parameters": patterns run once a point, and what they gave is the state.
TEST_F(RixBxdfPage, BeginScatterIsBegin) {
  const Shader shader = compile(surface_of(R"(<texcoord name="uv" type="vector2"/>
    <separate2 name="parts" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
    <combine3 name="color" type="color3"><input name="in1" type="float" nodename="parts" output="outx"/></combine3>
    <oren_nayar_diffuse_bsdf name="b" type="BSDF"><input name="color" type="color3" nodename="color"/></oren_nayar_diffuse_bsdf>)"));
  EXPECT_TRUE(reads(shader, NACRE_BEGIN, "uv0"));
  EXPECT_FALSE(reads(shader, NACRE_EVALUATE, "uv0"));
  EXPECT_FALSE(reads(shader, NACRE_SAMPLE, "uv0"));
  const Columns out = ask(shader, NACRE_EVALUATE, {{"uv0.x", {0.25f, 0.75f}}}, 2);
  EXPECT_FLOAT_EQ(out.at("f.x")[0], 0.25f / pi);
  EXPECT_FLOAT_EQ(out.at("f.x")[1], 0.75f / pi);
}

// "GenerateSample() generates one sample for each point", "EvaluateSample() evaluates one direction
// for each point", and "return consistent results".
TEST_F(RixBxdfPage, SampleAndEvaluateAgree) {
  constexpr std::size_t count = 500;
  const Shader shader = compile(surface_of(glass));
  Columns in = random(direction(40), count);
  const Columns sample = ask(shader, NACRE_SAMPLE, in, count);
  put(in, "wi", sampled(sample));
  const Columns value = ask(shader, NACRE_EVALUATE, in, count);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_valid(sample, i)) continue;
    ++valid;
    const float f = sample.at("weight.x")[i] * sample.at("pdf")[i];
    ASSERT_NEAR(value.at("pdf")[i], sample.at("pdf")[i], 1e-4f * sample.at("pdf")[i]) << i;
    ASSERT_NEAR(value.at("f.x")[i], f, 2e-4f * f) << i;
  }
  EXPECT_GT(valid, count / 2);
}

// "EvaluateSamplesAtIndex() evaluates one-or-many directions for a given point", with all that may
// be asked of it.
TEST_F(RixBxdfPage, EvaluateSamplesAtIndexIsEvaluateAt) {
  CompileOptions options;
  options.entries = 1u << NACRE_EVALUATE | 1u << NACRE_EVALUATE_AT;
  options.lobes_wanted = options.transport = options.by_lobe = options.reverse_pdf = true;
  const Shader shader =
      compile(surface_of(lobe("oren_nayar_diffuse_bsdf", "", "d") +
                         lobe("dielectric_bsdf",
                              given("scatter_mode", "string", "RT") + facets("0.3"), "g") +
                         both("d", "g", "0.5")),
              options);
  const std::vector<Direction> wi = sphere(40);
  Columns in = directions({direction(20), direction(50), direction(70)}, wi);
  const std::vector<std::int32_t> wanted{NACRE_DIFFUSE_REFLECTION, NACRE_GLOSSY_TRANSMISSION,
                                         NACRE_GLOSSY_REFLECTION | NACRE_DIFFUSE_REFLECTION};
  for (std::uint32_t point = 0; point < 3; ++point) {
    in["transport"] = {bits(NACRE_RADIANCE)};
    in["lobes_wanted"].clear();
    for (const std::int32_t each : wanted) in["lobes_wanted"].push_back(bits(each));
    const Columns at = ask(shader, NACRE_EVALUATE_AT, in, wi.size(), 3, point);
    Columns one = directions({direction(point == 0 ? 20 : point == 1 ? 50 : 70)}, wi);
    one["transport"] = in["transport"];
    one["lobes_wanted"] = {bits(wanted[point])};
    const Columns each = ask(shader, NACRE_EVALUATE, one, wi.size());
    ASSERT_EQ(at.size(), each.size());
    for (const auto& [name, column] : at) {
      for (std::size_t i = 0; i < wi.size(); ++i) {
        if (name == "kinds") {
          ASSERT_EQ(integer(column[i]), integer(each.at(name)[i])) << i;
          continue;
        }
        ASSERT_NEAR(column[i], each.at(name)[i], 1e-5f * each.at(name)[i]) << name << i;
      }
    }
    EXPECT_GT(*std::ranges::max_element(at.at("f.x")), 0.0f);
  }
}

// "EmitLocal() to retrieve the bxdf's local emission", and "Bxdfs that do not scatter light (e.g.
// PxrConstant) should disable all lobes and set the forward pdf and reversed pdf to zero".
TEST_F(RixBxdfPage, WhatOnlyEmitsHasNoLobes) {
  const Shader shader = compile(R"(<materialx version="1.39">
    <surface_unlit name="S" type="surfaceshader"><input name="emission_color" type="color3" value="2, 3, 4"/></surface_unlit>
    <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  </materialx>)");
  EXPECT_EQ(ask(shader, NACRE_EMISSION, {}).at("emission.y")[0], 3.0f);
  EXPECT_TRUE(shader.lobes().empty());
  for (const nacre_entry entry : {NACRE_BEGIN, NACRE_SAMPLE, NACRE_EVALUATE, NACRE_ALBEDO}) {
    EXPECT_FALSE(shader.has(entry)) << entry;
  }
}

// Paths that begin at a light have directions of what it emits: each carries the power that it has.
TEST_F(RixBxdfPage, EmittedLightHasDirections) {
  constexpr std::size_t count = 300;
  CompileOptions options;
  options.entries = 1u << NACRE_EMISSION | 1u << NACRE_EMIT;
  const Shader shader = compile(R"(<materialx version="1.39">
    <surface_unlit name="S" type="surfaceshader"><input name="emission_color" type="color3" value="2, 3, 4"/></surface_unlit>
    <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  </materialx>)",
                                options);
  EXPECT_FALSE(reads(shader, NACRE_EMIT, "wo"));
  const Columns emitted = ask(shader, NACRE_EMIT, random(direction(0), count), count);
  std::vector<Direction> wo;
  for (std::size_t i = 0; i < count; ++i) {
    wo.push_back(
        {emitted.at("emitted.x")[i], emitted.at("emitted.y")[i], emitted.at("emitted.z")[i]});
    EXPECT_NEAR(emitted.at("weight.y")[i], 3 * 2 * pi, 1e-4f) << i;
  }
  Columns seen;
  put(seen, "wo", wo);
  const Columns again = ask(shader, NACRE_EMISSION, seen, count);
  EXPECT_EQ(again.at("pdf"), emitted.at("pdf"));
  EXPECT_EQ(again.at("emission.x"), std::vector<float>(count, 2.0f));
}

// The same at a point of a surface that scatters elsewhere.
TEST_F(RixBxdfPage, PointsThatScatterNothingHaveDensitiesOfZero) {
  CompileOptions options;
  options.reverse_pdf = true;
  const Shader shader = compile(surface_of(R"(<texcoord name="uv" type="vector2"/>
    <separate2 name="parts" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
    <oren_nayar_diffuse_bsdf name="b" type="BSDF"><input name="weight" type="float" nodename="parts" output="outx"/></oren_nayar_diffuse_bsdf>)"),
                                options);
  const Columns in{{"uv0.x", {0.0f, 1.0f}}, {"u.x", {0.5f}}};
  const Columns value = ask(shader, NACRE_EVALUATE, in, 2);
  const Columns sample = ask(shader, NACRE_SAMPLE, in, 2);
  for (const Columns& out : {value, sample}) {
    for (const char* pdf : {"pdf", "pdf_reverse"}) {
      EXPECT_EQ(out.at(pdf)[0], 0.0f) << pdf;
      EXPECT_GT(out.at(pdf)[1], 0.0f) << pdf;
    }
  }
  EXPECT_EQ(integer(sample.at("flags")[0]), 0);
  EXPECT_EQ(integer(sample.at("flags")[1]), NACRE_SAMPLE_VALID);
}

// "The forward pdf should account for light moving from the L to V direction where as the reverse
// pdf account for the opposite": one is the other of exchanged directions.
TEST_F(RixBxdfPage, BothDensitiesAreExchangedByTheDirections) {
  CompileOptions options;
  options.reverse_pdf = true;
  const Shader shader = compile(surface_of(glass), options);
  const std::vector<Direction> wi = sphere(60);
  const std::vector<Direction> wo(wi.size(), direction(35));
  const Columns there = ask(shader, NACRE_EVALUATE, directions(wo, wi), wi.size());
  const Columns back = ask(shader, NACRE_EVALUATE, directions(wi, wo), wi.size());
  for (std::size_t i = 0; i < wi.size(); ++i) {
    const float forward = there.at("pdf")[i], reverse = there.at("pdf_reverse")[i];
    ASSERT_NEAR(forward, back.at("pdf_reverse")[i], 1e-4f * forward + 1e-6f) << i;
    ASSERT_NEAR(reverse, back.at("pdf")[i], 1e-4f * reverse + 1e-6f) << i;
  }
  EXPECT_NE(there.at("pdf")[3], there.at("pdf_reverse")[3]);
}

// "Bxdfs are expected to conserve energy and obey the Helmholtz reciprocity."
TEST_F(RixBxdfPage, EnergyIsConservedAndDirectionsExchange) {
  const Shader rough = compile(surface_of(glass));
  constexpr std::size_t count = 20000;
  const double energy =
      mean(ask(rough, NACRE_SAMPLE, random(direction(30), count), count).at("weight.x"));
  EXPECT_NEAR(energy, 1.0, 0.02);  // White glass; nothing is lost, nothing is won.
  const Shader diffuse =
      compile(surface_of(lobe("oren_nayar_diffuse_bsdf", given("roughness", "float", "0.7"))));
  const Direction a = direction(65, 10), b = direction(25, 130);
  const float there = ask(diffuse, NACRE_EVALUATE, directions({a}, {b})).at("f.x")[0] / b.z;
  const float back = ask(diffuse, NACRE_EVALUATE, directions({b}, {a})).at("f.x")[0] / a.z;
  EXPECT_NEAR(there, back, 1e-5f * there);
}

// "GetPresence() to evaluate the geometry presence", "GetOpacity() to evaluate the opacity color":
// apart, and what NACRE_OPACITY says in one formula.
TEST_F(RixBxdfPage, PresenceAndOpacityColourAreApart) {
  CompileOptions options;
  options.entries = 1u << NACRE_SHADOW | 1u << NACRE_OPACITY;
  const Shader shader = compile(R"(<materialx version="1.39">
    <surface_unlit name="S" type="surfaceshader"><input name="opacity" type="float" value="0.5"/>
      <input name="transmission" type="float" value="1"/>
      <input name="transmission_color" type="color3" value="0.75, 0.5, 0"/></surface_unlit>
    <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  </materialx>)",
                                options);
  const Columns shadow = ask(shader, NACRE_SHADOW, {});
  EXPECT_EQ(shadow.at("presence")[0], 0.5f);
  EXPECT_EQ(shadow.at("opacity_color.x")[0], 0.25f);
  EXPECT_EQ(shadow.at("opacity_color.y")[0], 0.5f);
  EXPECT_EQ(shadow.at("opacity_color.z")[0], 1.0f);
  const Columns opacity = ask(shader, NACRE_OPACITY, {});
  const float passes = 1 - opacity.at("opacity")[0] * (1 - opacity.at("transmission.x")[0]);
  EXPECT_EQ(1 - shadow.at("presence")[0] * shadow.at("opacity_color.x")[0], passes);
}

// A thin wall of smooth glass tints shadows: what Fresnel reflects and the tint takes is held back,
// as much as `sample` sends straight on.
TEST_F(RixBxdfPage, OpacityColourIsOfStraightLightThroughThinWalls) {
  CompileOptions options;
  options.entries = 1u << NACRE_SHADOW | 1u << NACRE_SAMPLE;
  const auto wall = [&](const std::string& alpha, const std::string& thin) {
    return compile(
        surface_of(lobe("dielectric_bsdf", given("scatter_mode", "string", "RT") + facets(alpha) +
                                               given("ior", "float", "1.5") +
                                               given("tint", "color3", "0.5, 0.25, 1")),
                   given("thin_walled", "boolean", thin)),
        options);
  };
  const Shader shader = wall("0", "true");
  const Columns shadow = ask(shader, NACRE_SHADOW, {});
  EXPECT_EQ(shadow.at("presence")[0], 1.0f);
  EXPECT_NEAR(shadow.at("opacity_color.x")[0], 1 - 0.5f * 0.96f, 1e-6f);
  EXPECT_NEAR(shadow.at("opacity_color.y")[0], 1 - 0.25f * 0.96f, 1e-6f);
  EXPECT_NEAR(shadow.at("opacity_color.z")[0], 0.04f, 1e-6f);
  Columns in = random(direction(60), 4000);
  const Columns sample = ask(shader, NACRE_SAMPLE, in, 4000);
  double straight = 0;
  for (std::size_t i = 0; i < 4000; ++i) {
    const bool passes = (integer(sample.at("flags")[i]) & NACRE_SAMPLE_TRANSMISSION) != 0;
    if (!passes) continue;
    EXPECT_NEAR(sample.at("wi.z")[i], -0.5f, 1e-6f);
    straight += static_cast<double>(sample.at("weight.y")[i]) / 4000;
  }
  const Columns oblique = ask(shader, NACRE_SHADOW, in);
  EXPECT_NEAR(1 - oblique.at("opacity_color.y")[0], straight, 5e-3);
  // What is bent or spread is not straight.
  EXPECT_FALSE(wall("0", "false").has(NACRE_SHADOW));
  EXPECT_FALSE(wall("0.2", "true").has(NACRE_SHADOW));
}

// "There is one instance of a RixBxdfFactory ... may be active in multiple threads simultaneously."
TEST_F(RixBxdfPage, OneShaderServesManyThreads) {
  const Shader shader = compile(surface_of(glass));
  const Columns in = random(direction(50), 300);
  std::vector<Columns> found(4);
  std::vector<std::thread> threads;
  for (Columns& out : found) {
    threads.emplace_back([&] { out = ask(shader, NACRE_SAMPLE, in, 300); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Columns& out : found) {
    for (const auto& [name, column] : out) {
      for (std::size_t i = 0; i < 300; ++i) {
        ASSERT_EQ(integer(column[i]), integer(found[0].at(name)[i])) << name;
      }
    }
  }
}

// "Bxdf Evaluation Domain": both sides of the surface, each from its own.
TEST_F(RixBxdfPage, BothSidesAreSeen) {
  const Shader paper = compile(surface_of(lambert));
  const Shader leaf = compile(surface_of(lobe("translucent_bsdf")));
  for (const float side : {1.0f, -1.0f}) {
    const Columns same{{"wo.z", {side}}, {"wi.z", {side}}};
    const Columns other{{"wo.z", {side}}, {"wi.z", {-side}}};
    EXPECT_FLOAT_EQ(ask(paper, NACRE_EVALUATE, same).at("f.x")[0], 0.8f / pi);
    EXPECT_EQ(ask(paper, NACRE_EVALUATE, other).at("f.x")[0], 0.0f);
    EXPECT_EQ(ask(leaf, NACRE_EVALUATE, same).at("f.x")[0], 0.0f);
    EXPECT_GT(ask(leaf, NACRE_EVALUATE, other).at("f.x")[0], 0.1f);
  }
}

// "Bxdf Sample Validity": flags say which samples are none, and these weigh nothing.
TEST_F(RixBxdfPage, LostSamplesAreMarked) {
  CompileOptions options;
  options.reverse_pdf = true;
  const Shader shader = compile(surface_of(glass), options);
  constexpr std::size_t count = 2000;
  const Columns sample = ask(shader, NACRE_SAMPLE, random(direction(85), count), count);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (is_valid(sample, i)) continue;
    ++lost;
    for (const char* name : {"weight.x", "weight.y", "weight.z", "pdf", "pdf_reverse"}) {
      ASSERT_EQ(sample.at(name)[i], 0.0f) << name;
    }
  }
  EXPECT_GT(lost, 0u);
  EXPECT_LT(lost, count / 2);
}

// "Query Ray Properties": what a graph reads of the ray is a property that comes with each point.
TEST_F(RixBxdfPage, RayPropertiesComeWithThePoint) {
  const Shader shader = compile(surface_of(R"(
    <geompropvalue name="depth" type="float"><input name="geomprop" type="string" value="ray_depth"/></geompropvalue>
    <divide name="fading" type="float"><input name="in1" type="float" value="1"/>
      <input name="in2" type="float" nodename="depth"/></divide>
    <oren_nayar_diffuse_bsdf name="b" type="BSDF"><input name="weight" type="float" nodename="fading"/>
      <input name="color" type="color3" value="1, 1, 1"/></oren_nayar_diffuse_bsdf>)"));
  const Columns out = ask(shader, NACRE_EVALUATE, {{"geomprop.ray_depth.x", {1.0f, 4.0f}}}, 2);
  EXPECT_FLOAT_EQ(out.at("f.x")[1], out.at("f.x")[0] / 4);
}

// "Args files ... parameter names, default values, localization and GUI hints", by GetParamTable().
TEST_F(RixBxdfPage, ParametersHaveDefaultsAndHints) {
  CompileOptions options;
  options.live = {"S/coat"};
  const Shader shader = compile(R"(<materialx version="1.39">
    <standard_surface name="S" type="surfaceshader"/>
    <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  </materialx>)",
                                options);
  const std::vector<Parameter> parameters = shader.parameters();
  const auto coat = std::ranges::find(parameters, "S/coat", &Parameter::name);
  ASSERT_NE(coat, parameters.end());
  EXPECT_EQ(coat->value, std::vector<float>{0.0f});
  EXPECT_EQ(coat->minimum, std::vector<float>{0.0f});
  EXPECT_EQ(coat->maximum, std::vector<float>{1.0f});
  EXPECT_EQ(coat->folder, "Coat");
}

}  // namespace
}  // namespace nacre
