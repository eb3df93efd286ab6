// `nacre check --lobe`: what closures must hold, said of the lobes of a node pack.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/examples/tool/tool_fixture.h"
#include "tests/support/lambert_text.h"

namespace nacre {
namespace {

class LobeNodes : public Tool {
 protected:
  LobeNodes() {
    write("pack.mtlx", R"(<materialx version="1.39">
  <nodedef name="ND_own" node="own">
    <input name="color" type="color3" value="0.5, 0.25, 0.75"/>
    <output name="out" type="BSDF"/></nodedef>
  <implementation name="IM_own" nodedef="ND_own" file="own.glsl" function="own"/>
</materialx>)");
  }

  /// The exit status of checking the lobe that the text has.
  int check(const std::string& text, const std::string& more = "") {
    write("own.glsl", text);
    return run("check " + file("pack.mtlx") +
               " --lobe own --samples 20000 --sets 3 --backend interpreter " + more);
  }
  /// The laws that are broken by that text, by what is said.
  std::string broken(const LambertText& text) {
    EXPECT_EQ(check(text.text()), 1) << printed_;
    EXPECT_TRUE(says("pack.mtlx:2:")) << errors_;
    std::string laws;
    for (std::size_t at = errors_.find("[lobe-"); at != std::string::npos;
         at = errors_.find("[lobe-", at + 1)) {
      const std::string law = errors_.substr(at + 6, errors_.find(']', at) - at - 6);
      laws += (laws.empty() ? "" : " ") + law;
    }
    return laws;
  }
};

TEST_F(LobeNodes, HoldTheLaws) {
  ASSERT_EQ(check(LambertText().text()), 0) << errors_ << printed_;
  EXPECT_NE(printed_.find("ND_own: laws, 3 sets of inputs"), std::string::npos) << printed_;
  EXPECT_NE(printed_.find("ND_own, set 1: defaults: light that leaves"), std::string::npos);
  EXPECT_NE(printed_.find("ND_own, set 3: color=1, 1, 1:"), std::string::npos) << printed_;
  EXPECT_EQ(printed_.find("BROKEN"), std::string::npos) << printed_;
  ASSERT_EQ(check(LambertText().text(), "--json"), 0) << errors_;
  const auto found = nlohmann::json::parse(printed_);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0]["lobe"], "ND_own");
  EXPECT_EQ(found[0]["laws"].size(), 13u);
  for (const auto& law : found[0]["laws"]) EXPECT_EQ(law["state"], "holds") << law;
  const double light[3][3] = {{0.5, 0.25, 0.75}, {0, 0, 0}, {1, 1, 1}};
  ASSERT_EQ(found[0]["sets"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    for (const auto& view : found[0]["sets"][i]["views"]) {
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(view["light"][k], light[i][k], 1e-3) << i;
    }
  }
}

TEST_F(LobeNodes, AreNamedWithTheLawThatDoesNotHold) {
  EXPECT_EQ(broken({.f = "1.2 * color * wi.z / M_PI", .albedo = "min(1.2 * color, vec3(1.0))"}),
            "energy");
  EXPECT_EQ(broken({.albedo = "0.9 * color"}), "albedo");
  EXPECT_NE(broken({.pdf = "0.5 / M_PI"}).find("samples"), std::string::npos);
  EXPECT_NE(broken({.pdf = "0.95 * wi.z / M_PI"}).find("normalised"), std::string::npos);
  EXPECT_NE(broken({.sample = "vec3(0.0, 0.0, 1.1)"}).find("unit"), std::string::npos);
  // In pictures this is black.
  EXPECT_NE(broken({.f = "color * log(wi.z - 0.5)"}).find("finite"), std::string::npos);
}

TEST_F(LobeNodes, AreNotTriedWhereTheyAreWrong) {
  std::string text = LambertText().text();
  text.replace(text.find("float own_pdf"), 13, "float own_qdf");
  EXPECT_EQ(check(text), 1);
  EXPECT_TRUE(says("[source-misfit]")) << errors_;
  EXPECT_TRUE(says("float own_pdf(vec3 wo, vec3 wi, vec3 color)")) << errors_;
  EXPECT_EQ(printed_.find("laws"), std::string::npos) << printed_;
}

/// The law of Lommel and Seeliger, whose integral is known.
TEST_F(LobeNodes, OfTheExampleAreRight) {
  const std::string folder = std::string(NACRE_SOURCE_DIR) + "/examples/node_pack/";
  ASSERT_EQ(run("check " + folder +
                "nodes/pack.mtlx --lobe ND_pack_dust --sets 4 --samples 20000 "
                "--backend interpreter --json"),
            0)
      << errors_;
  const auto found = nlohmann::json::parse(printed_);
  for (const auto& view : found[0]["sets"][2]["views"]) {
    const double mu = std::cos(double(view["degrees"]) * 0.017453292519943295);
    const double light = 0.5 * (1.0 - mu * std::log((1.0 + mu) / mu));
    EXPECT_NEAR(view["light"][0], light, 0.01);
    EXPECT_NEAR(view["albedo"][0], light, 1e-5);
    EXPECT_NEAR(view["reciprocity"], 1.0, 1e-3);
  }
  EXPECT_EQ(run("check " + folder + "dusty.mtlx --library " + folder +
                "nodes --lobes --samples 20000 --backend interpreter"),
            0)
      << errors_;
}

TEST_F(LobeNodes, OfTheLibraryAreTriedToo) {
  write("empty.mtlx", "<materialx version=\"1.39\"/>");
  const std::string head = "check " + file("empty.mtlx") + " --samples 20000 --sets 3 --lobe ";
  EXPECT_EQ(run(head + "translucent_bsdf --backend interpreter"), 0) << errors_;
  EXPECT_EQ(run(head + "burley_diffuse_bsdf --backend interpreter"), 0) << errors_;
  // The library's nodedef gives no range.
  EXPECT_NE(printed_.find("by default: roughness\n"), std::string::npos) << printed_;
  EXPECT_EQ(run(head + "nothing,marble"), 1);
  EXPECT_TRUE(says("[no-such-lobe]")) << errors_;
  EXPECT_EQ(run("check " + file("empty.mtlx") + " --sets 3"), 2);
}

}  // namespace
}  // namespace nacre
