// --fact: what is known of points, and what `nacre inspect` says it is worth.
#include <nlohmann/json.hpp>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

using Json = nlohmann::json;

constexpr const char* document = R"(<materialx version="1.39">
  <standard_surface name="S" type="surfaceshader">
    <input name="coat" type="float" value="0.5"/></standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
  <texcoord name="uv" type="vector2"/>
  <separate2 name="parts" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
  <sin name="s" type="float"><input name="in" type="float" nodename="parts" output="outx"/></sin>
  <output name="wave" type="float" nodename="s"/></materialx>)";

using ToolFacts = Tool;

TEST_F(ToolFacts, InspectSaysWhatTheySave) {
  const std::string mtlx = write("d.mtlx", document);
  const std::string facts = " --fact S/coat=0,0 --fact 'dot(N,wo)=0.01,1.001' --fact P=-1,1";
  ASSERT_EQ(run("inspect " + mtlx + " --material M --live --json" + facts), 0) << errors_;
  const Json found = Json::parse(printed_)[0]["facts"];
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0]["name"], "S/coat");
  EXPECT_EQ(found[0]["maximum"], 0.0);
  EXPECT_GT(found[0]["saved"].get<int>(), 100);
  EXPECT_EQ(found[2]["saved"], 0);
  ASSERT_EQ(run("inspect " + mtlx + " --material M --live" + facts), 0) << errors_;
  EXPECT_NE(printed_.find("fact: S/coat in [0, 0]: "), std::string::npos) << printed_;
}

// sin of a small angle has no path for large ones.
TEST_F(ToolFacts, SmallAnglesNeedNoLargeOnes) {
  const std::string mtlx = write("d.mtlx", document);
  const auto size = [&](const std::string& options) {
    EXPECT_EQ(run("inspect " + mtlx + " --output wave --json" + options), 0) << errors_;
    return Json::parse(printed_)[0]["kernel"]["instructions"].get<int>();
  };
  EXPECT_LT(size(" --fact uv0=-10,10"), size("") - 50);
}

TEST_F(ToolFacts, BakesHaveTheSameBytes) {
  const std::string mtlx = write("d.mtlx", document);
  const std::string bake = "bake " + mtlx + " --output wave --size 32 --format exr --quiet --out ";
  ASSERT_EQ(run(bake + file("a")), 0) << errors_;
  ASSERT_EQ(run(bake + file("b") + " --fact uv0=0,1"), 0) << errors_;
  // Of most points it is not true.
  ASSERT_EQ(run(bake + file("c") + " --fact uv0=0,0.25"), 0) << errors_;
  EXPECT_TRUE(text_of(file("a/wave.exr")) == text_of(file("b/wave.exr")));
  EXPECT_TRUE(text_of(file("a/wave.exr")) == text_of(file("c/wave.exr")));
}

TEST_F(ToolFacts, ThatCannotBeReadAreRefused) {
  const std::string mtlx = write("d.mtlx", document);
  for (const char* wrong : {"uv0", "uv0=1", "uv0=a,b", "uv0=0,1x"}) {
    EXPECT_EQ(run("inspect " + mtlx + " --fact " + wrong), 2) << wrong;
    EXPECT_NE(errors_.find("NAME=MIN,MAX"), std::string::npos) << errors_;
  }
  EXPECT_EQ(run("inspect " + mtlx + " --fact uv0=1,0"), 1);
  EXPECT_NE(errors_.find("bad-fact"), std::string::npos) << errors_;
}

}  // namespace
}  // namespace nacre
