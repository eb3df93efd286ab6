// `nacre tune`, and what other commands make of its profiles.
#include <nlohmann/json.hpp>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

using Json = nlohmann::json;

/// A material "M", metal of a given look, and an output "bumps".
constexpr const char* document = R"(<materialx version="1.39">
  <conductor_bsdf name="b" type="BSDF">
    <input name="roughness" type="vector2" value="0.6, 0.6"/></conductor_bsdf>
  <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <texcoord name="uv" type="vector2"/>
  <fractal2d name="noise" type="float"><input name="texcoord" type="vector2" nodename="uv"/>
  </fractal2d>
  <exp name="e" type="float"><input name="in" type="float" nodename="noise"/></exp>
  <output name="bumps" type="float" nodename="e"/></materialx>)";

using Tune = Tool;

TEST_F(Tune, WritesAProfileOfAllThatTheDocumentHas) {
  const std::string mtlx = write("d.mtlx", document);
  ASSERT_EQ(run("tune " + mtlx + " --max-error 0.05 --no-times --profile " + file("p.json")), 0)
      << errors_;
  EXPECT_NE(printed_.find("material M"), std::string::npos) << printed_;
  EXPECT_NE(printed_.find("output bumps"), std::string::npos) << printed_;
  const Json profile = Json::parse(text_of(file("p.json")));
  ASSERT_EQ(profile["subjects"].size(), 2u);
  for (const Json& subject : profile["subjects"]) {
    EXPECT_LE(subject["unseen_error"]["p999"].get<double>(), 0.05);
    EXPECT_LE(subject["cost"].get<double>(), subject["standard_cost"].get<double>());
  }
  ASSERT_EQ(run("tune " + mtlx + " --max-error 0.05 --no-times --profile " + file("q.json")), 0);
  EXPECT_EQ(text_of(file("p.json")), text_of(file("q.json")));
}

TEST_F(Tune, AProfileIsWhatItsOptionsAre) {
  const std::string mtlx = write("d.mtlx", document);
  write("p.json", R"({"nacre_profile": 1, "subjects": [
    {"output": "bumps", "choices": {"accuracy": "fast"}},
    {"material": "M", "choices": {"accuracy": "precise", "compensation": "nothing"}}]})");
  const std::string bake = "bake " + mtlx + " --output bumps --size 32 --format exr --quiet --out ";
  ASSERT_EQ(run(bake + file("a") + " --profile " + file("p.json")), 0) << errors_;
  ASSERT_EQ(run(bake + file("b") + " --accuracy fast"), 0) << errors_;
  ASSERT_EQ(run(bake + file("c")), 0) << errors_;
  EXPECT_TRUE(text_of(file("a/bumps.exr")) == text_of(file("b/bumps.exr")));
  EXPECT_FALSE(text_of(file("a/bumps.exr")) == text_of(file("c/bumps.exr")));

  const std::string inspect = "inspect " + mtlx + " --material M --json";
  const auto kernels = [&](const std::string& options) {
    EXPECT_EQ(run(inspect + options), 0) << errors_;
    return Json::parse(printed_)[0]["kernels"];
  };
  const Json of_profile = kernels(" --profile " + file("p.json"));
  EXPECT_EQ(of_profile, kernels(" --accuracy precise --compensation nothing"));
  EXPECT_NE(of_profile, kernels(""));

  const std::string render =
      "render " + mtlx + " --material M --spp 1 --size 16x16 --quiet --wait-for-code --out ";
  write("q.json", R"({"nacre_profile": 1, "subjects": [
    {"material": "M", "choices": {"compensation": "nothing"}}]})");
  ASSERT_EQ(run(render + file("a.exr") + " --profile " + file("q.json")), 0) << errors_;
  ASSERT_EQ(run(render + file("b.exr") + " --compensation nothing"), 0) << errors_;
  ASSERT_EQ(run(render + file("c.exr")), 0) << errors_;
  EXPECT_TRUE(text_of(file("a.exr")) == text_of(file("b.exr")));
  EXPECT_FALSE(text_of(file("a.exr")) == text_of(file("c.exr")));
}

TEST_F(Tune, WhatAProfileDoesNotHaveIsWarnedOf) {
  const std::string mtlx = write("d.mtlx", document);
  write("p.json", R"({"nacre_profile": 1, "subjects": []})");
  EXPECT_EQ(run("inspect " + mtlx + " --material M --profile " + file("p.json")), 0);
  EXPECT_TRUE(says("not-in-profile")) << errors_;
  write("q.json", R"({"nacre_profile": 1, "subjects": [{"material": "m", "choices": {}}]})");
  EXPECT_EQ(run("inspect " + mtlx + " --material M --profile " + file("q.json")), 0);
  EXPECT_TRUE(says("not-in-profile") && says("it differs only in case from 'm'")) << errors_;
}

TEST_F(Tune, BadUseIsRefused) {
  const std::string mtlx = write("d.mtlx", document);
  write("p.json", "{}");
  EXPECT_EQ(run("inspect " + mtlx + " --profile " + file("p.json")), 1);
  EXPECT_TRUE(says("bad-profile")) << errors_;
  EXPECT_EQ(run("inspect " + mtlx + " --profile " + file("none.json")), 1);
  EXPECT_EQ(run("inspect " + mtlx + " --accuracy fast --profile " + file("p.json")), 2);
  EXPECT_EQ(run("tune " + mtlx + " --max-error -1"), 2);
  EXPECT_EQ(run("tune " + mtlx + " --metric other"), 2);
  EXPECT_EQ(run("tune " + mtlx + " --material none"), 1);
  EXPECT_EQ(run("tune " + mtlx + " --profile " + file("q.json") + " --max-error 1e-30"), 1);
  EXPECT_TRUE(says("no-such-error")) << errors_;
  EXPECT_FALSE(std::filesystem::exists(file("q.json")));
}

}  // namespace
}  // namespace nacre
