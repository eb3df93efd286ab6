// `nacre check --lobes`: what closures must hold, said of the materials of a document.
#include <nlohmann/json.hpp>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

std::string material(const std::string& bsdf) {
  return R"(<materialx version="1.39">
  )" + bsdf +
         R"(
  <surface name="s" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
</materialx>)";
}

class LobeTool : public Tool {
 protected:
  std::string text_;
};

TEST_F(LobeTool, PrintsWhatLeavesOfTheLight) {
  write("metal.mtlx", material(R"(<conductor_bsdf name="b" type="BSDF">
    <input name="ior" type="color3" value="0, 0, 0"/>
    <input name="roughness" type="vector2" value="0.3, 0.3"/></conductor_bsdf>)"));
  const std::string check = "check " + file("metal.mtlx") + " --lobes --samples 20000";
  ASSERT_EQ(run(check), 0) << errors_;
  EXPECT_NE(printed_.find("M (front)"), std::string::npos) << printed_;
  ASSERT_EQ(run(check + " --json"), 0) << errors_;
  const auto found = nlohmann::json::parse(printed_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0]["material"], "M");
  EXPECT_TRUE(found[0]["faults"].empty());
  ASSERT_FALSE(found[0]["views"].empty());
  for (const auto& view : found[0]["views"]) {
    for (const double light : view["light"]) EXPECT_NEAR(light, 1.0, 0.02) << view;
  }
}

// Burley's diffuse gains at grazing angles where it is rough: a property of the model.
TEST_F(LobeTool, NamesTheLawThatDoesNotHold) {
  write("rough.mtlx", material(R"(<burley_diffuse_bsdf name="b" type="BSDF">
    <input name="color" type="color3" value="1, 1, 1"/>
    <input name="roughness" type="float" value="1"/></burley_diffuse_bsdf>)"));
  const std::string check = "check " + file("rough.mtlx") + " --lobes --samples 20000";
  EXPECT_EQ(run(check), 1);
  EXPECT_NE(errors_.find("rough.mtlx:6:"), std::string::npos) << errors_;
  EXPECT_NE(errors_.find("[lobe-energy]"), std::string::npos) << errors_;
  EXPECT_EQ(run(check + " --most-energy 1.6"), 0) << errors_;
  EXPECT_EQ(run("check " + file("rough.mtlx") + " --samples 20000"), 2);
}

// Facets that are rough one way and smooth the other scatter into a fan that quadrature does not
// see all of. That is no fault of theirs, and said; of what is seen all laws are tried.
TEST_F(LobeTool, SaysWhatIsTooThinToIntegrate) {
  const auto views_of = [&](const std::string& roughness) {
    write("facets.mtlx", material(R"(<dielectric_bsdf name="b" type="BSDF">
      <input name="roughness" type="vector2" value=")" +
                                  roughness + R"("/>
      <input name="scatter_mode" type="string" value="RT"/></dielectric_bsdf>)"));
    const std::string check = "check " + file("facets.mtlx") + " --lobes";
    EXPECT_EQ(run(check), 0) << roughness << errors_;
    text_ = printed_;
    EXPECT_EQ(run(check + " --json"), 0) << errors_;
    return nlohmann::json::parse(printed_)[0]["views"];
  };
  std::size_t thin = 0;
  for (const auto& view : views_of("1, 0")) {
    if (!view["too_thin"].get<bool>()) continue;
    ++thin;
    EXPECT_EQ(view["chi_square"], 1.0);
  }
  EXPECT_GT(thin, 0u);
  EXPECT_LT(thin, 5u);
  EXPECT_NE(text_.find("too thin to integrate"), std::string::npos) << text_;
  for (const auto& view : views_of("1, 0.01")) {
    EXPECT_FALSE(view["too_thin"].get<bool>());
    EXPECT_LT(view["chi_square"], 1.0);
  }
  EXPECT_EQ(text_.find("too thin"), std::string::npos) << text_;
}

// What has nothing to be tried is named too.
TEST_F(LobeTool, SaysWhatHasNoClosure) {
  write("light.mtlx", R"(<materialx version="1.39">
  <uniform_edf name="e" type="EDF"/>
  <surface name="s" type="surfaceshader"><input name="edf" type="EDF" nodename="e"/></surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
</materialx>)");
  const std::string check = "check " + file("light.mtlx") + " --lobes";
  ASSERT_EQ(run(check), 0) << errors_;
  EXPECT_NE(printed_.find("M (front): no closure"), std::string::npos) << printed_;
  ASSERT_EQ(run(check + " --json"), 0) << errors_;
  const auto found = nlohmann::json::parse(printed_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0]["views"].empty());
}

}  // namespace
}  // namespace nacre
