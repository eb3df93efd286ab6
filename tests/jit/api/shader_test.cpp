// A host that has nothing but <nacre/nacre.hpp>.
#include <gtest/gtest.h>

#include <algorithm>
#include <nacre/nacre.hpp>
#include <string>
#include <vector>

#include "tests/jit/api/surface_document.h"
#include "tests/jit/api/surface_points.h"

namespace nacre {
namespace {

System& shared_system() {
  static System system;
  return system;
}

Shader compiled(const std::string& text, const CompileOptions& options = {}) {
  return shared_system().compile_material(Document::parse(text), "M", options);
}

CompileOptions live(std::vector<std::string> patterns, std::vector<std::string> varying = {}) {
  CompileOptions options;
  options.live = std::move(patterns);
  options.varying = std::move(varying);
  return options;
}

constexpr std::size_t count = 1200;

TEST(ApiShader, SampledDirectionsEvaluateToTheirWeight) {
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"));
  SurfacePoints points(count);
  points.shade(shader);
  std::size_t valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if ((points.flags[i] & NACRE_SAMPLE_VALID) == 0 || points.sample_pdf[i] < 1e-3f) continue;
    ++valid;
    ASSERT_NEAR(points.f[3 * i] / points.pdf[i], points.weight[3 * i],
                1e-3f * points.weight[3 * i] + 1e-4f)
        << i;
  }
  EXPECT_GT(valid, count / 2);
}

TEST(ApiShader, ListedPointsGetWhatAllOfThemGet) {
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"));
  SurfacePoints all(count);
  all.shade(shader);
  SurfacePoints parts(count);
  std::vector<std::uint32_t> even, odd;
  for (std::uint32_t i = 0; i < count; ++i) (i % 3 == 0 ? even : odd).push_back(i);
  std::vector<float> pdfs(count);
  const Binding binding(parts.binder(), shader);
  parts.shade(binding, nullptr, &even);
  const std::vector<float> first = parts.sample_pdf;
  parts.shade(binding, nullptr, &odd);
  for (const std::uint32_t i : even) parts.sample_pdf[i] = first[i];
  EXPECT_TRUE(parts.same_results(all));
}

// Calls of many points make tables of their own; of few points they do not.
TEST(ApiShader, CallsOfAnySizeGiveTheSameBits) {
  for (const int accuracy : {NACRE_PRECISE, NACRE_STANDARD, NACRE_FAST}) {
    CompileOptions options = live({"*"});
    options.accuracy = accuracy;
    const Shader shader = compiled(surface_document("0.8, 0.3, 0.1", "0.5"), options);
    SurfacePoints all(count);
    all.shade(shader);
    const std::vector<std::uint32_t> sizes{1, 7, 30, 100, 150};
    std::uint32_t first = 0;
    for (std::size_t k = 0; first < count; ++k) {
      std::vector<std::uint32_t> list;
      for (std::uint32_t i = 0; i < sizes[k % sizes.size()] && first < count; ++i) {
        list.push_back(first++);
      }
      SurfacePoints some(count);
      some.shade(shader, nullptr, &list);
      for (const std::uint32_t i : list) {
        ASSERT_EQ(some.f[3 * i], all.f[3 * i]) << accuracy << ' ' << i;
        ASSERT_EQ(some.weight[3 * i + 1], all.weight[3 * i + 1]) << accuracy << ' ' << i;
        ASSERT_EQ(some.sample_pdf[i], all.sample_pdf[i]) << accuracy << ' ' << i;
        ASSERT_EQ(some.albedo[3 * i + 2], all.albedo[3 * i + 2]) << accuracy << ' ' << i;
      }
    }
  }
}

TEST(ApiShader, AnInstanceIsTheDocumentWithItsValues) {
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"), live({"S/*"}));
  Instance instance(shader);
  SurfacePoints found(count), expected(count);
  found.shade(shader, &instance);
  expected.shade(compiled(surface_document("0.8, 0.3, 0.1")));
  for (std::size_t i = 0; i < count; ++i) {
    // Folded constants and slots may round apart, here and there by an ulp or so.
    ASSERT_NEAR(found.albedo[3 * i], expected.albedo[3 * i], 1e-5f) << i;
  }
  // metalness is no input of the document: the pattern makes it one.
  instance.set("S/base_color", {0.1f, 0.9f, 0.4f});
  instance.set("S/metalness", 0.75f);
  found.shade(shader, &instance);
  expected.shade(compiled(surface_document("0.1, 0.9, 0.4", "0.75")));
  for (std::size_t i = 0; i < 3 * count; ++i) {
    ASSERT_NEAR(found.albedo[i], expected.albedo[i], 1e-5f) << i;
  }
}

TEST(ApiShader, PointsOfSeveralInstancesAreOneBatch) {
  const std::vector<std::string> patterns{"S/base_color", "S/metalness"};
  const Shader uniform = compiled(surface_document("0.8, 0.3, 0.1"), live(patterns));
  const Shader varying = compiled(surface_document("0.8, 0.3, 0.1"), live(patterns, patterns));
  struct Look {
    float color[3];
    float metalness;
  };
  std::vector<Look> looks{
      {{0.8f, 0.3f, 0.1f}, 0.0f}, {{0.1f, 0.2f, 0.9f}, 1.0f}, {{0.5f, 0.5f, 0.5f}, 0.25f}};
  SurfacePoints mixed(count);
  for (std::size_t i = 0; i < count; ++i) {
    mixed.instances[i] = static_cast<std::uint32_t>(i * 7 % looks.size());
  }
  Binder binder = mixed.binder();
  binder.array("S/base_color", {9, 0, sizeof(Look), 4, NACRE_OF_INSTANCE});
  binder.array("S/metalness", {9, 12, sizeof(Look), 4, NACRE_OF_INSTANCE});
  const Binding binding(binder, varying);
  std::vector<void*> arrays = mixed.arrays();
  arrays.push_back(looks.data());
  Batch batch;
  batch.count = count;
  batch.instances = mixed.instances.data();
  for (const nacre_entry entry : {NACRE_BEGIN, NACRE_SAMPLE, NACRE_EVALUATE, NACRE_ALBEDO}) {
    ASSERT_TRUE(binding.run(entry, arrays, batch));
  }
  for (std::size_t k = 0; k < looks.size(); ++k) {
    Instance instance(uniform);
    instance.set("S/base_color", {looks[k].color[0], looks[k].color[1], looks[k].color[2]});
    instance.set("S/metalness", looks[k].metalness);
    SurfacePoints alone(count);
    alone.shade(uniform, &instance);
    for (std::size_t i = 0; i < count; ++i) {
      if (mixed.instances[i] != k) continue;
      ASSERT_EQ(mixed.albedo[3 * i], alone.albedo[3 * i]) << i;
      ASSERT_EQ(mixed.f[3 * i + 1], alone.f[3 * i + 1]) << i;
      ASSERT_EQ(mixed.weight[3 * i + 2], alone.weight[3 * i + 2]) << i;
    }
  }
}

TEST(ApiShader, ParametersSayWhatAnInterfaceNeeds) {
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"), live({"S/*color"}));
  const std::vector<Parameter> all = shader.parameters();
  const auto found = std::find_if(
      all.begin(), all.end(), [](const Parameter& each) { return each.name == "S/base_color"; });
  ASSERT_NE(found, all.end());
  EXPECT_EQ(found->type, "color3");
  EXPECT_EQ(found->components, 3);
  EXPECT_EQ(found->value, (std::vector<float>{0.8f, 0.3f, 0.1f}));
  // As standard_surface's nodedef has it.
  EXPECT_EQ(found->label, "Base Color");
  EXPECT_EQ(found->folder, "Base");
  EXPECT_EQ(found->minimum, (std::vector<float>{0, 0, 0}));
  EXPECT_EQ(found->maximum, (std::vector<float>{1, 1, 1}));
  EXPECT_FALSE(found->document.empty());
  for (const Parameter& each : all) EXPECT_NE(each.name, "S/metalness");
}

TEST(ApiShader, ChannelsHaveUnitsAndMeanings) {
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"));
  for (const nacre_entry entry : {NACRE_BEGIN, NACRE_SAMPLE, NACRE_EVALUATE, NACRE_ALBEDO}) {
    EXPECT_FALSE(shader.inputs(entry).empty());
    for (const auto& list : {shader.inputs(entry), shader.results(entry)}) {
      for (const Channel& each : list) EXPECT_FALSE(each.meaning.empty()) << each.name;
    }
  }
}

TEST(ApiShader, WhatIsBoundToNothingIsSaid) {
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"));
  Binder binder;
  binder.constant("N", {0, 0, 1});
  try {
    const Binding binding(binder, shader);
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), NACRE_FAILED);
    ASSERT_FALSE(error.diagnostics().empty());
    EXPECT_EQ(error.diagnostics().front().code, "unbound-channel");
    EXPECT_NE(std::string(error.what()).find("uv0.x"), std::string::npos) << error.what();
  }
}

TEST(ApiShader, WrongValuesAreRefusedWithTheReason) {
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"), live({"S/base_color"}));
  Instance instance(shader);
  EXPECT_THROW(instance.set("S/base_color", 1.0f), Error);
  EXPECT_THROW(instance.set("S/base_color", true), Error);
  EXPECT_THROW(instance.set("S/metalness", 1.0f), Error);
  EXPECT_NO_THROW(instance.set("S/base_color", {1.0f, 1.0f, 1.0f}));
}

TEST(ApiShader, AnInstanceSaysWhatItHas) {
  CompileOptions options = live({"S/base_color"});
  options.lobe_mask = true;
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"), options);
  Instance instance(shader);
  EXPECT_EQ(instance.value("S/base_color"), (std::vector<float>{0.8f, 0.3f, 0.1f}));
  instance.set("S/base_color", {0.25f, 0.5f, 1.0f});
  EXPECT_EQ(instance.value("S/base_color"), (std::vector<float>{0.25f, 0.5f, 1.0f}));
  instance.set("lobe_mask", NACRE_GLOSSY_REFLECTION);
  EXPECT_EQ(instance.value("lobe_mask"), std::vector<float>{NACRE_GLOSSY_REFLECTION});
  EXPECT_THROW(instance.value("S/metalness"), Error);
}

// The same for all points: of integers by their bits, which a float of that value has not.
TEST(ApiShader, ConstantsAreNumbersOrIntegers) {
  CompileOptions options;
  options.lobes_wanted = true;
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"), options);
  SurfacePoints points(count);
  const auto bound = [&](int wanted) {
    Binder binder = points.binder();
    binder.integers("lobes_wanted", {wanted});
    return Binding(binder, shader);
  };
  points.shade(bound(NACRE_DIFFUSE_REFLECTION | NACRE_GLOSSY_REFLECTION));
  const std::vector<float> both = points.f;
  Batch batch;
  batch.count = count;
  const auto evaluated = [&](int wanted) {
    bound(wanted).run(NACRE_EVALUATE, points.arrays(), batch);
    return points.f;
  };
  const std::vector<float> diffuse = evaluated(NACRE_DIFFUSE_REFLECTION);
  const std::vector<float> glossy = evaluated(NACRE_GLOSSY_REFLECTION);
  EXPECT_EQ(evaluated(0), std::vector<float>(both.size(), 0.0f));
  for (std::size_t i = 0; i < both.size(); ++i) {
    ASSERT_NEAR(diffuse[i] + glossy[i], both[i], 1e-5f * both[i]) << i;
  }
}

TEST(ApiShader, ChannelGroupsAreATable) {
  const std::vector<ChannelGroup> groups = channel_groups();
  const auto found = std::find_if(groups.begin(), groups.end(),
                                  [](const ChannelGroup& each) { return each.name == "dPdx"; });
  ASSERT_NE(found, groups.end());
  EXPECT_EQ(found->role, NACRE_POINT);
  EXPECT_EQ(found->components, 3);
  EXPECT_EQ(found->type, NACRE_FLOAT);
  EXPECT_EQ(found->unit, "scene units per sample");
}

// The mean free paths of what is below a surface change the picture; a lobe of weight 0 does not.
TEST(ApiShader, WhatIsLeftOutMayChangeThePicture) {
  const Shader shader = compiled(R"(<materialx version="1.39">
    <standard_surface name="S" type="surfaceshader">
      <input name="subsurface" type="float" value="0.5"/></standard_surface>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  </materialx>)");
  const std::vector<std::string> all = shader.left_out();
  const std::vector<std::string> visible = shader.left_out(true);
  EXPECT_LT(visible.size(), all.size());
  ASSERT_EQ(visible.size(), 1u);
  EXPECT_NE(visible[0].find("subsurface"), std::string::npos) << visible[0];
}

TEST(ApiShader, ErrorsOfDocumentsCarryTheirPlace) {
  try {
    Document::parse("<materialx version=\"1.39\"><mix name=\"m\"", "broken.mtlx");
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    ASSERT_FALSE(error.diagnostics().empty());
    EXPECT_EQ(error.diagnostics().front().file, "broken.mtlx");
    EXPECT_EQ(error.diagnostics().front().line, 1);
  }
}

TEST(ApiShader, OutputsAreValuesByName) {
  const Document document = Document::parse(R"(<materialx version="1.39">
    <texcoord name="uv" type="vector2"/>
    <multiply name="twice" type="vector2"><input name="in1" type="vector2" nodename="uv"/>
      <input name="in2" type="float" value="2"/></multiply>
    <output name="out" type="vector2" nodename="twice"/></materialx>)");
  EXPECT_EQ(document.outputs(), std::vector<std::string>{"out"});
  EXPECT_TRUE(document.materials().empty());
  const Shader shader = shared_system().compile_outputs(document, {"out"});
  ASSERT_TRUE(shader.has(NACRE_OUTPUTS));
  EXPECT_FALSE(shader.has(NACRE_BEGIN));
  Binder binder;
  binder.array("uv0", {0, 0, 8}).array("out", {1, 0, 8});
  const Binding binding(binder, shader);
  std::vector<float> uv{0.5f, 1.0f, -3.0f, 0.25f}, out(4);
  const std::vector<void*> arrays{uv.data(), out.data()};
  Batch batch;
  batch.count = 2;
  ASSERT_TRUE(binding.run(NACRE_OUTPUTS, arrays, batch));
  EXPECT_EQ(out, (std::vector<float>{1.0f, 2.0f, -6.0f, 0.5f}));
}

TEST(ApiShader, GeometricPropertiesAreThereIfTheyAreBound) {
  const Document document = Document::parse(R"(<materialx version="1.39">
    <geompropvalue name="age" type="float"><input name="geomprop" type="string" value="age"/>
      <input name="default" type="float" value="7"/></geompropvalue>
    <output name="out" type="float" nodename="age"/></materialx>)");
  const Shader shader = shared_system().compile_outputs(document, {"out"});
  std::vector<float> ages{1, 2, 3}, out(3);
  const std::vector<void*> arrays{ages.data(), out.data()};
  Batch batch;
  batch.count = 3;
  Binder without;
  without.array("out", {1});
  Binding(without, shader).run(NACRE_OUTPUTS, arrays, batch);
  EXPECT_EQ(out, (std::vector<float>{7, 7, 7}));
  Binder with;
  with.array("out", {1}).array("geomprop.age", {0});
  Binding(with, shader).run(NACRE_OUTPUTS, arrays, batch);
  EXPECT_EQ(out, ages);
}

TEST(ApiShader, ObjectsOutliveWhatTheyWereMadeOf) {
  SurfacePoints points(64);
  auto binding = [&] {
    System system;
    const Shader shader =
        system.compile_material(Document::parse(surface_document("0.8, 0.3, 0.1")), "M");
    return Binding(points.binder(), shader);
  }();
  points.shade(binding);
  EXPECT_GT(points.albedo[0], 0.0f);
}

TEST(ApiShader, AStopEndsARun) {
  const Shader shader = compiled(surface_document("0.8, 0.3, 0.1"));
  SurfacePoints points(count);
  const Binding binding(points.binder(), shader);
  const volatile std::uint32_t stop = 1;
  Batch batch;
  batch.count = count;
  batch.stop = &stop;
  EXPECT_FALSE(binding.run(NACRE_BEGIN, points.arrays(), batch));
}

TEST(ApiShader, ThatLacksAnImageIsAnErrorUnlessTheHostLetsItPass) {
  const std::string text = R"(<materialx version="1.39">
    <image name="I" type="color3"><input name="file" type="filename" value="none.png"/></image>
    <output name="out" type="color3" nodename="I"/></materialx>)";
  try {
    shared_system().compile_outputs(Document::parse(text), {"out"});
    FAIL() << "nothing was said";
  } catch (const Error& error) {
    EXPECT_EQ(error.diagnostics().front().path, "I") << error.what();
  }
  CompileOptions options;
  options.missing_images_pass = true;
  std::vector<Diagnostic> said;
  shared_system().compile_outputs(Document::parse(text), {"out"}, options, &said);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said.front().severity, NACRE_WARNING);
}

}  // namespace
}  // namespace nacre
