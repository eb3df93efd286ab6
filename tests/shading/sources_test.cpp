// Nodes that a document, a pack or the host brings, on every engine.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"
#include "tests/document/standard_library.h"
#include "tests/support/run_kernel.h"

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
         .standard_sources = true},
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

}  // namespace
}  // namespace nacre
