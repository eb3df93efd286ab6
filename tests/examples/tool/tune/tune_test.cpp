// `nacre tune`, and what other commands make of its profiles.
#include <cmath>
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

// The scene without a file: a ball of radius 1 around the origin.
TEST_F(Tune, PointsAreRecordedWhereTheSceneIs) {
  const std::string mtlx = write("d.mtlx", document);
  const std::string render = "render " + mtlx +
                             " --spp 4 --size 64 --quiet --wait-for-code --out " + file("a.exr") +
                             " --record-points ";
  ASSERT_EQ(run(render + file("p.json") + " --threads 1"), 0) << errors_;
  ASSERT_EQ(run(render + file("q.json") + " --threads 2"), 0) << errors_;
  EXPECT_TRUE(text_of(file("p.json")) == text_of(file("q.json")));
  const Json points = Json::parse(text_of(file("p.json")));
  ASSERT_EQ(points["materials"].size(), 1u);
  const Json& own = points["materials"][0];
  EXPECT_EQ(own["material"], "M");
  const auto count = own["count"].get<std::size_t>();
  EXPECT_GT(count, 1000u);
  const auto length_of = [&](const std::string& name, std::size_t i) {
    double sum = 0;
    for (const char* axis : {".x", ".y", ".z"}) {
      const double x = own["channels"][name + axis][i].get<double>();
      sum += x * x;
    }
    return std::sqrt(sum);
  };
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(length_of("N", i), 1, 1e-5);
    EXPECT_NEAR(length_of("wo", i), 1, 1e-5);
  }
  ASSERT_EQ(run("tune " + mtlx + " --no-times --recorded " + file("p.json") + " --json"), 0);
  const Json tuned = Json::parse(printed_);
  EXPECT_EQ(tuned[0]["points"], std::to_string(count / 2) + " points that a renderer has recorded");
  // Of an output nothing is recorded.
  EXPECT_NE(tuned[1]["points"].get<std::string>().find("[0, 1]^2"), std::string::npos);
  EXPECT_TRUE(says("not-recorded")) << errors_;
}

TEST_F(Tune, FrontsAreDrawn) {
  const std::string mtlx = write("d.mtlx", document);
  ASSERT_EQ(run("tune " + mtlx + " --no-times --json --plot " + file("p.svg")), 0) << errors_;
  std::size_t steps = 0;
  for (const Json& each : Json::parse(printed_)) steps += each["front"].size();
  const std::string svg = text_of(file("p.svg"));
  const auto count = [&](std::string_view tag) {
    std::size_t found = 0;
    for (std::size_t at = svg.find(tag); at != svg.npos; at = svg.find(tag, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<polyline"), 2u);
  EXPECT_EQ(count("<circle"), steps + 4);  // Two are chosen, two standard.
  EXPECT_EQ(run("tune " + mtlx + " --plot " + file("p.svg/q.svg")), 1);
}

TEST_F(Tune, EndsInTime) {
  const std::string mtlx = write("d.mtlx", document);
  ASSERT_EQ(run("tune " + mtlx + " --time-limit 1e-6 --profile " + file("p.json")), 0) << errors_;
  EXPECT_TRUE(says("cut-short")) << errors_;
  for (const Json& subject : Json::parse(text_of(file("p.json")))["subjects"]) {
    EXPECT_LE(subject["unseen_error"]["p999"].get<double>(), 0.01);
  }
}

TEST_F(Tune, InspectSaysHowFarKernelsAreOff) {
  const std::string mtlx = write("d.mtlx", document);
  const auto error = [&](const std::string& options) {
    EXPECT_EQ(run("inspect " + mtlx + " --json --error --material M " + options), 0) << errors_;
    return Json::parse(printed_)[0]["error"]["p999"].get<double>();
  };
  EXPECT_LT(error("--accuracy precise"), 1e-4);
  EXPECT_GT(error("--compensation nothing"), 1e-2);
  EXPECT_EQ(run("inspect " + mtlx + " --error --output bumps"), 0);
  EXPECT_NE(printed_.find("of a thousand"), std::string::npos) << printed_;
  EXPECT_EQ(run("inspect " + mtlx + " --error --recorded " + mtlx), 1);
  EXPECT_TRUE(says("bad-points")) << errors_;
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
