// Images that give one texel by a number that each point brings along.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <nacre/nacre.hpp>
#include <random>
#include <string>
#include <vector>

namespace nacre {
namespace {

constexpr const char* document = R"(<materialx version="1.39">
  <image name="i" type="color3"><input name="file" type="filename" value="painted"/></image>
  <tiledimage name="t" type="color3"><input name="file" type="filename" value="painted"/>
    <input name="uvtiling" type="vector2" value="3, 2"/>
    <input name="filtertype" type="string" value="cubic"/></tiledimage>
  <hextiledimage name="h" type="color3"><input name="file" type="filename" value="painted"/>
  </hextiledimage>
  <extract name="height" type="float"><input name="in" type="color3" nodename="i"/></extract>
  <heighttonormal name="n" type="vector3"><input name="in" type="float" nodename="height"/>
  </heighttonormal>
  <output name="image_out" type="color3" nodename="i"/>
  <output name="tiled_out" type="color3" nodename="t"/>
  <output name="hex_out" type="color3" nodename="h"/>
  <output name="normal_out" type="vector3" nodename="n"/>
  <oren_nayar_diffuse_bsdf name="b" type="BSDF"><input name="color" type="color3" nodename="i"/>
  </oren_nayar_diffuse_bsdf>
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
  <displacement name="d" type="displacementshader">
    <input name="displacement" type="float" nodename="height"/></displacement>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="s"/>
    <input name="displacementshader" type="displacementshader" nodename="d"/></surfacematerial>
</materialx>)";

using Columns = std::map<std::string, std::vector<float>>;

class ApiDrawnTexels : public ::testing::Test {
 protected:
  void SetUp() override {
    std::mt19937 random(5);
    std::vector<std::uint8_t> texels(16 * 8 * 3);
    for (std::uint8_t& each : texels) each = static_cast<std::uint8_t>(random());
    system.set_image("painted", {16, 8, 3, NACRE_UINT8, texels.data(), 0});
  }

  static CompileOptions drawing() {
    CompileOptions options;
    options.varying = {"texture_u"};
    return options;
  }
  Shader compile(const std::string& output, const CompileOptions& options) {
    return system.compile_outputs(Document::parse(document), {output}, options);
  }

  static std::vector<float> run(const Shader& shader, const std::string& output, Columns columns) {
    Binder binder;
    std::vector<void*> arrays;
    const std::size_t count = columns.begin()->second.size();
    for (auto& [name, column] : columns) {
      binder.array(name, {static_cast<std::uint32_t>(arrays.size())});
      arrays.push_back(column.data());
    }
    std::vector<float> results(3 * count);
    for (std::size_t i = 0; i < 3; ++i) {
      const char component = "xyz"[i];
      binder.array(output + '.' + component, {static_cast<std::uint32_t>(arrays.size())});
      arrays.push_back(results.data() + i * count);
    }
    Batch batch;
    batch.count = count;
    Binding(binder, shader).run(NACRE_OUTPUTS, arrays, batch);
    return results;
  }

  /// Points whose extent is a few texels, longer than wide.
  static Columns points(std::size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-1, 2), extent(-0.4f, 0.4f), number(0, 1);
    Columns columns;
    for (const char* name :
         {"uv0.x", "uv0.y", "duv0dx.x", "duv0dx.y", "duv0dy.x", "duv0dy.y", "texture_u"}) {
      for (std::size_t i = 0; i < count; ++i) {
        columns[name].push_back(name[0] == 'u'   ? place(random)
                                : name[0] == 't' ? number(random)
                                                 : extent(random));
      }
    }
    return columns;
  }

  static bool reads(const Shader& shader, nacre_entry entry) {
    return std::ranges::any_of(shader.inputs(entry),
                               [](const Channel& each) { return each.name == "texture_u"; });
  }

  System system;
};

TEST_F(ApiDrawnTexels, AreTheSameOnAllEngines) {
  std::vector<CompileOptions> engines(5, drawing());
  for (std::size_t i = 0; i < 4; ++i) engines[i].lanes = std::array{1, 4, 8, 16}[i];
  engines[4].engine = NACRE_INTERPRETER;
  const Columns in = points(203);
  for (const std::string output : {"image_out", "tiled_out", "hex_out", "normal_out"}) {
    const auto first = run(compile(output, engines[4]), output, in);
    for (const CompileOptions& engine : engines) {
      EXPECT_EQ(run(compile(output, engine), output, in), first) << output << ' ' << engine.lanes;
    }
  }
}

// Of the same number: a host that gives all points one number sees one texel of each.
TEST_F(ApiDrawnTexels, HangOnTheNumber) {
  Columns in = points(400);
  const Shader shader = compile("image_out", drawing());
  const auto one = run(shader, "image_out", in);
  EXPECT_EQ(run(shader, "image_out", in), one);
  std::ranges::reverse(in.at("texture_u"));
  const auto other = run(shader, "image_out", in);
  std::size_t same = 0;
  for (std::size_t i = 0; i < one.size(); ++i) same += one[i] == other[i] ? 1 : 0;
  EXPECT_LT(same, one.size() / 2);
}

// Slopes are those of the filtered image; so are normals, where nothing else is drawn.
TEST_F(ApiDrawnTexels, AreNotWhatNormalsAreOf) {
  const Columns in = points(300);
  Columns plain = in;
  plain.erase("texture_u");
  const Shader drawn = compile("normal_out", drawing());
  EXPECT_FALSE(reads(drawn, NACRE_OUTPUTS));
  EXPECT_EQ(run(drawn, "normal_out", plain), run(compile("normal_out", {}), "normal_out", plain));
}

// Media, too; and of an image at one place, which has no slope that asks for the filter.
TEST_F(ApiDrawnTexels, LeaveMediaAlone) {
  CompileOptions options = drawing();
  options.entries = 1u << NACRE_INTERIOR | 1u << NACRE_DISPLACEMENT;
  const Shader shader = system.compile_material(Document::parse(R"(<materialx version="1.39">
    <image name="i" type="color3"><input name="file" type="filename" value="painted"/>
      <input name="texcoord" type="vector2" value="0.3, 0.4"/></image>
    <extract name="height" type="float"><input name="in" type="color3" nodename="i"/></extract>
    <open_pbr_surface name="s" type="surfaceshader">
      <input name="transmission_weight" type="float" value="1"/>
      <input name="transmission_depth" type="float" value="1"/>
      <input name="transmission_color" type="color3" nodename="i"/></open_pbr_surface>
    <displacement name="d" type="displacementshader">
      <input name="displacement" type="float" nodename="height"/></displacement>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="s"/>
      <input name="displacementshader" type="displacementshader" nodename="d"/></surfacematerial>
    </materialx>)"),
                                                "M", options);
  ASSERT_TRUE(shader.has(NACRE_DISPLACEMENT));
  EXPECT_FALSE(reads(shader, NACRE_DISPLACEMENT));
  ASSERT_TRUE(shader.has(NACRE_INTERIOR));
  EXPECT_FALSE(reads(shader, NACRE_INTERIOR));
}

TEST_F(ApiDrawnTexels, SayWhatTheyReadAndLeaveDisplacementAlone) {
  CompileOptions options = drawing();
  const Shader shader = system.compile_material(Document::parse(document), "M", options);
  EXPECT_TRUE(reads(shader, NACRE_ALBEDO));
  ASSERT_TRUE(shader.has(NACRE_DISPLACEMENT));
  EXPECT_FALSE(reads(shader, NACRE_DISPLACEMENT));
  for (const Channel& input : shader.inputs(NACRE_ALBEDO)) {
    if (input.name != "texture_u") continue;
    EXPECT_EQ(input.role, NACRE_POINT);
    EXPECT_EQ(input.type, NACRE_FLOAT);
    EXPECT_FALSE(input.meaning.empty());
  }
  EXPECT_FALSE(reads(system.compile_material(Document::parse(document), "M"), NACRE_ALBEDO));
}

}  // namespace
}  // namespace nacre
