// Nodes that a document, a pack or the host brings, on every engine.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/support/run_kernel.h"
#include "tests/support/standard_library.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

const fs::path& pack_folder() {
  static const fs::path folder = fs::path(NACRE_SOURCE_DIR) / "examples/node_pack";
  return folder;
}

Columns grid() {
  Columns columns;
  for (int i = 0; i < 23 * 17; ++i) {
    columns["uv0.x"].push_back((static_cast<float>(i % 23) + 0.5f) / 23.0f);
    columns["uv0.y"].push_back((static_cast<float>(i / 23) + 0.5f) / 17.0f);
  }
  return columns;
}

class Sources : public ::testing::Test {
 protected:
  void open(std::vector<HostBody> bodies = {}) {
    system_ =
        ShadingSystem::create({.libraries = {standard_library_folder(), pack_folder() / "nodes"},
                               .bodies = std::move(bodies),
                               .standard_texts = true},
                              diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
  }

  std::unique_ptr<Document> document(const std::string& body) {
    return read_document_text("<materialx version=\"1.39\">\n" + body + "</materialx>",
                              (pack_folder() / "test.mtlx").string(), {}, diagnostics_);
  }

  Columns run_output(const Document& document, const std::string& output, Backend backend,
                     Preference prefer = Preference::body) {
    ShaderOptions options;
    options.compile.backend = backend;
    options.graph.prefer = prefer;
    const auto made = system_->compile_outputs(document, {output}, options, diagnostics_);
    EXPECT_NE(made, nullptr) << diagnostics_.to_string();
    return made == nullptr ? Columns{} : run(made->kernel.kernel(), grid());
  }

  /// The interpreter's results, after comparing the JIT's with them bit by bit.
  Columns run_both(const Document& document, const std::string& output,
                   Preference prefer = Preference::body) {
    Columns interpreted = run_output(document, output, Backend::interpreter, prefer);
    const Columns compiled = run_output(document, output, Backend::jit, prefer);
    EXPECT_EQ(interpreted.size(), compiled.size());
    for (const auto& [name, column] : interpreted) {
      for (std::size_t i = 0; i < column.size(); ++i) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(column[i]),
                  std::bit_cast<std::uint32_t>(compiled.at(name)[i]))
            << name << ' ' << i;
      }
    }
    return interpreted;
  }

  /// The first complaint about a document that brings `implementation` for a node
  /// of one float input and one float output.
  std::string complaint(const std::string& implementation) {
    const auto made = document(
        "<nodedef name=\"ND_own\" node=\"own\"><input name=\"in\" type=\"float\" value=\"0\"/>"
        "<output name=\"out\" type=\"float\"/></nodedef>\n" +
        implementation + "\n<own name=\"n\" type=\"float\"/>\n");
    Diagnostics diagnostics;
    system_->check(*made, {}, diagnostics);
    if (diagnostics.all().empty()) return "";
    const Diagnostic& first = diagnostics.all().front();
    return first.code + ' ' + fs::path(first.where.file).filename().string() + ':' +
           std::to_string(first.where.line) + ':' + std::to_string(first.where.column);
  }

  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

/// The pack's weave, worked out again.
TEST_F(Sources, APackInGlslRunsOnEveryEngine) {
  open();
  const auto made = document(R"(
    <pack_weave name="weave" type="multioutput">
      <input name="pattern" type="string" value="twill"/>
    </pack_weave>
    <output name="height" type="float" nodename="weave" output="height"/>
    <output name="color" type="color3" nodename="weave" output="color"/>)");
  const Columns heights = run_both(*made, "height");
  const Columns colors = run_both(*made, "color");
  const Columns points = grid();
  for (std::size_t i = 0; i < points.at("uv0.x").size(); ++i) {
    const double x = 12.0 * points.at("uv0.x")[i];
    const double y = 12.0 * points.at("uv0.y")[i];
    const bool is_warp = std::fmod(std::floor(x) + std::floor(y), 4.0) < 2.0;
    const double along = is_warp ? x : y;
    const double across = 2.0 * (along - std::floor(along)) - 1.0;
    const double height = std::sqrt(std::max(0.0, 1.0 - across * across));
    EXPECT_NEAR(heights.at("height")[i], height, 1e-4);
    EXPECT_NEAR(colors.at("color.z")[i], (is_warp ? 0.3 : 0.4) * (0.4 + 0.6 * height), 1e-4);
  }
}

TEST_F(Sources, AnInlineExpressionRuns) {
  open();
  const auto made = document(R"(
    <texcoord name="uv" type="vector2"/>
    <extract name="u" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
    <pack_sigmoid name="s" type="float"><input name="in" type="float" nodename="u"/></pack_sigmoid>
    <output name="out" type="float" nodename="s"/>)");
  const Columns results = run_both(*made, "out");
  const Columns points = grid();
  for (std::size_t i = 0; i < points.at("uv0.x").size(); ++i) {
    const double expected = 1.0 / (1.0 + std::exp(4.0 * (0.5 - points.at("uv0.x")[i])));
    EXPECT_NEAR(results.at("out")[i], expected, 1e-6);
  }
}

TEST_F(Sources, AHostsBodyReplacesWhatThereIs) {
  open({{"ND_pack_sigmoid_float",
         [](NodeCall& call) { call.set(call.number("in") * 3.0f + call.number("pivot")); }}});
  const auto made = document(R"(
    <pack_sigmoid name="s" type="float"><input name="in" type="float" value="2"/></pack_sigmoid>
    <output name="out" type="float" nodename="s"/>)");
  EXPECT_EQ(run_both(*made, "out").at("out").front(), 6.5f);
}

TEST_F(Sources, AHostsBodyNeedsANodedef) {
  EXPECT_EQ(ShadingSystem::create({.libraries = {standard_library_folder()},
                                   .bodies = {{"ND_nothing", [](NodeCall&) {}}}},
                                  diagnostics_),
            nullptr);
  ASSERT_TRUE(diagnostics_.has_errors());
  EXPECT_EQ(diagnostics_.all().front().code, "unknown-nodedef");
}

/// The library's own text, where asked for, on the engines that users run.
TEST_F(Sources, TheLibrarysTextCanBePreferred) {
  open();
  const auto made = document(R"(
    <fractal2d name="f" type="vector3"><input name="octaves" type="integer" value="4"/></fractal2d>
    <worleynoise2d name="w" type="float"/>
    <output name="fractal" type="vector3" nodename="f"/>
    <output name="worley" type="float" nodename="w"/>)");
  for (const char* output : {"fractal", "worley"}) {
    const Columns ours = run_both(*made, output);
    const Columns theirs = run_both(*made, output, Preference::source);
    for (const auto& [name, column] : ours) {
      for (std::size_t i = 0; i < column.size(); ++i) {
        EXPECT_NEAR(column[i], theirs.at(name)[i], 2e-6) << name << ' ' << i;
      }
    }
  }
}

// MaterialX's generators give the functions of its image nodes two parameters that no nodedef has.
TEST_F(Sources, ImagesAreReadByTheirBodiesWhateverIsPreferred) {
  open();
  const auto made = document(R"(
    <image name="i" type="color3"><input name="default" type="color3" value="0.25, 0.5, 1"/></image>
    <output name="out" type="color3" nodename="i"/>)");
  EXPECT_EQ(run_both(*made, "out", Preference::source), run_both(*made, "out"));
}

/// A node that takes a structure and gives one, whose members the text has as well.
constexpr std::string_view structures = R"mtlx(
  <typedef name="coord"><member name="s" type="float" value="0.5"/>
    <member name="t" type="vector2" value="0.25, 0.75"/></typedef>
  <typedef name="patch"><member name="at" type="coord"/><member name="turns" type="integer" value="2"/>
    <member name="tint" type="color3" value="1, 0.5, 0.25"/></typedef>
  <nodedef name="ND_gather" node="gather">
    <input name="uv" type="vector2" defaultgeomprop="UV0"/><output name="out" type="patch"/></nodedef>
  <nodedef name="ND_move" node="move"><input name="amount" type="float" value="2"/>
    <input name="in" type="patch"/><output name="out" type="patch"/><output name="sum" type="float"/>
  </nodedef>
  <nodedef name="ND_spread" node="spread"><input name="in" type="patch"/>
    <output name="out" type="color3"/></nodedef>
  <nodedef name="ND_same" node="same"><input name="in" type="patch"/>
    <output name="out" type="patch"/></nodedef>
  <implementation name="I1" nodedef="ND_gather" function="gather" sourcecode="
    struct Coord { float s; vec2 t; };
    struct Patch { Coord at; int turns; vec3 tint; };
    Patch gather(vec2 uv) { return Patch(Coord(uv.x, uv.yx), 3, vec3(uv, 1.0)); }"/>
  <implementation name="I2" nodedef="ND_move" function="move" sourcecode="
    struct C { float s; vec2 t; };
    struct P { C at; int turns; vec3 tint; };
    void move(float amount, P p, out P result, out float sum) {
      result = p;
      result.at.t = p.at.t * amount + vec2(p.at.s);
      result.turns += 1;
      sum = p.at.s + p.at.t.x + p.at.t.y + float(p.turns);
    }"/>
  <implementation name="I3" nodedef="ND_spread"
    sourcecode="{{in}}.tint * {{in}}.at.t.y + float({{in}}.turns)"/>
  <implementation name="I4" nodedef="ND_same" sourcecode="{{in}}"/>)mtlx";

/// Structures into a function, out of it, returned, and through an expression; the
/// formulas worked out again.
TEST_F(Sources, StructuresRunOnEveryEngine) {
  open();
  const auto made = document(std::string(structures) + R"(
    <gather name="g" type="patch"/>
    <move name="m" type="multioutput"><input name="in" type="patch" nodename="g"/></move>
    <same name="k" type="patch"><input name="in" type="patch" nodename="m" output="out"/></same>
    <spread name="s" type="color3"><input name="in" type="patch" nodename="k"/></spread>
    <move name="d" type="multioutput"/>
    <output name="out" type="color3" nodename="s"/>
    <output name="whole" type="patch" nodename="m" output="out"/>
    <output name="sum" type="float" nodename="m" output="sum"/>
    <output name="default" type="float" nodename="d" output="sum"/>)");
  const Columns colors = run_both(*made, "out");
  const Columns sums = run_both(*made, "sum");
  const Columns whole = run_both(*made, "whole");
  const Columns exact = run_output(*made, "out", Backend::reference);
  const Columns points = grid();
  for (std::size_t i = 0; i < points.at("uv0.x").size(); ++i) {
    const double u = points.at("uv0.x")[i];
    const double v = points.at("uv0.y")[i];
    EXPECT_NEAR(sums.at("sum")[i], u + v + u + 3.0, 1e-5);
    EXPECT_NEAR(whole.at("whole.at.t.x")[i], v * 2.0 + u, 1e-5);
    EXPECT_EQ(whole.at("whole.turns")[i], 4.0f);
    EXPECT_NEAR(colors.at("out.y")[i], v * (u * 2.0 + u) + 4.0, 1e-5);
    EXPECT_NEAR(exact.at("out.x")[i], u * (u * 2.0 + u) + 4.0, 1e-6);
  }
  EXPECT_EQ(run_both(*made, "default").at("default").front(), 0.5f + 0.25f + 0.75f + 2.0f);
}

/// What is wrong with a text's structure, member by member.
TEST_F(Sources, StructuresThatDifferAreNamed) {
  open();
  const auto fault = [&](const std::string& type, const std::string& parameter) {
    Diagnostics diagnostics;
    const auto made =
        document(R"(
      <typedef name="inner"><member name="a" type="float"/><member name="b" type="integer"/></typedef>
      <typedef name="outer"><member name="i" type="inner"/><member name="c" type="color3"/></typedef>
      <nodedef name="ND_x" node="x"><input name="in" type="outer"/><output name="out" type="float"/>
      </nodedef>
      <implementation name="I" nodedef="ND_x" function="f" sourcecode=")" +
                 type + " void f(" + parameter + R"mtlx( p, out float x) { x = 1.0; }"/>)mtlx");
    system_->check(*made, {}, diagnostics);
    if (diagnostics.all().empty()) return std::string();
    const Diagnostic& first = diagnostics.all().front();
    return first.code + ": " + first.expected + "; " + first.found;
  };
  const std::string inner = "struct I { float a; int b; };";
  EXPECT_EQ(fault(inner + "struct O { I i; vec3 c; };", "O"), "");
  EXPECT_EQ(fault(inner + "struct O { I i; vec3 c; };", "out O"), "source-misfit: O; out O");
  EXPECT_EQ(fault("", "vec3"), "source-misfit: a structure { struct i; vec3 c }; vec3");
  EXPECT_EQ(fault(inner + "struct O { I i; vec3 d; };", "O"), "source-misfit: vec3 c; vec3 d");
  EXPECT_EQ(fault(inner + "struct O { I i; vec4 c; };", "O"), "source-misfit: vec3 c; vec4 c");
  EXPECT_EQ(fault(inner + "struct O { vec3 c; I i; };", "O"),
            "source-misfit: a structure i; vec3 c");
  EXPECT_EQ(fault(inner + "struct O { I i; };", "O"), "source-misfit: vec3 c; no more members");
  EXPECT_EQ(fault(inner + "struct O { I i; vec3 c; int z; };", "O"),
            "source-misfit: no more members; int z");
  EXPECT_EQ(fault("struct I { float a; float b; }; struct O { I i; vec3 c; };", "O"),
            "source-misfit: int i.b; float i.b");
  EXPECT_EQ(fault("struct O { float i; vec3 c; };", "O"),
            "source-misfit: a structure { float a; int b }; float");
}

TEST_F(Sources, FaultsAreNamedWhereTheyStand) {
  open();
  const std::string head = "<implementation name=\"I\" nodedef=\"ND_own\" ";
  EXPECT_EQ(complaint(head + "sourcecode=\"{{in}} * 2.0\"/>"), "");
  EXPECT_EQ(complaint(head + "sourcecode=\"{{in}} * vec2(1.0)\"/>"), "source-misfit test.mtlx:3:2");
  EXPECT_EQ(complaint(head + "sourcecode=\"{{inn}} * 2.0\"/>"), "glsl-undefined test.mtlx:3:1");
  EXPECT_EQ(complaint(head + "sourcecode=\"{{in}} *\"/>"), "glsl-syntax test.mtlx:3:8");
  EXPECT_EQ(complaint(head + "file=\"none.glsl\" function=\"f\"/>"),
            "missing-source test.mtlx:3:2");
  EXPECT_EQ(complaint(head + "file=\"../../README.md\" function=\"f\"/>"),
            "missing-source test.mtlx:3:2");
  EXPECT_EQ(complaint(head + "file=\"nodes/weave.glsl\"/>"), "source-misfit test.mtlx:3:2");
  EXPECT_EQ(complaint(head + "file=\"nodes/weave.glsl\" function=\"g\"/>"),
            "source-misfit test.mtlx:3:2");
  EXPECT_EQ(complaint(head + "file=\"nodes/weave.glsl\" function=\"pack_weave\"/>"),
            "source-misfit test.mtlx:3:2");
}

/// What is kept of an earlier document answers no other question than the one that was asked.
TEST_F(Sources, AFileThatIsKnownNeedsItsFunctionStill) {
  open();
  const std::string head =
      "<implementation name=\"I\" nodedef=\"ND_own\" file=\"nodes/weave.glsl\"";
  EXPECT_EQ(complaint(head + " function=\"g\"/>"), "source-misfit test.mtlx:3:2");
  EXPECT_EQ(complaint(head + "/>"), "source-misfit test.mtlx:3:2");
}

TEST_F(Sources, TheSameTextInAnotherPlaceIsSaidThere) {
  open();
  const std::string text =
      "<implementation name=\"I\" nodedef=\"ND_own\" sourcecode=\"{{in}} * q\"/>";
  EXPECT_EQ(complaint(text), "glsl-undefined test.mtlx:3:10");
  EXPECT_EQ(complaint("\n\n" + text), "glsl-undefined test.mtlx:5:10");
}

/// Somebody edits a text, or what it includes, while the host runs.
TEST_F(Sources, AFileThatChangedIsReadAgain) {
  open();
  const TemporaryFolder folder;
  const auto value = [&] {
    const auto made = read_document_text(R"mtlx(<materialx version="1.39">
      <nodedef name="ND_own" node="own"><output name="out" type="float"/></nodedef>
      <implementation name="I" nodedef="ND_own" file="own.glsl" function="own"/>
      <own name="n" type="float"/><output name="out" type="float" nodename="n"/>
    </materialx>)mtlx",
                                         folder.file("own.mtlx"), {}, diagnostics_);
    return run_output(*made, "out", Backend::interpreter).at("out").front();
  };
  folder.write("scale.glsl", "#define SCALE 10.0\n");
  folder.write("own.glsl", "#include \"scale.glsl\"\nvoid own(out float x) { x = SCALE * 2.0; }");
  EXPECT_EQ(value(), 20.0f);
  folder.write("own.glsl", "#include \"scale.glsl\"\nvoid own(out float x) { x = SCALE * 3.0; }");
  EXPECT_EQ(value(), 30.0f);
  folder.write("scale.glsl", "#define SCALE 100.0\n");
  EXPECT_EQ(value(), 300.0f);
}

}  // namespace
}  // namespace nacre
