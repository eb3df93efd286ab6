// The tool begins in the interpreter and changes to compiled code; what it writes does not
// know which of the two it was. And what kernels cost, by the nodes they are of.

#include <nlohmann/json.hpp>
#include <set>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

constexpr const char* waves = R"(<?xml version="1.0"?>
<materialx version="1.39">
  <nodegraph name="NG">
    <texcoord name="uv" type="vector2" />
    <fractal2d name="clouds" type="float">
      <input name="octaves" type="integer" value="6" />
      <input name="texcoord" type="vector2" nodename="uv" />
    </fractal2d>
    <sin name="wave" type="float"><input name="in" type="float" nodename="clouds" /></sin>
    <output name="out" type="float" nodename="wave" />
  </nodegraph>
</materialx>
)";

class Engines : public Tool {};

TEST_F(Engines, BakesAreTheSameFilesByEveryEngine) {
  const std::string document = write("a.mtlx", waves);
  std::set<std::string> pictures;
  for (const char* how : {"--no-cache", "--no-cache --wait-for-code", "--backend interpreter",
                          "--no-cache --compile-here", "--no-cache --threads 1",
                          "--no-cache --compile-here --wait-for-code"}) {
    ASSERT_EQ(run("bake " + document + " -q --size 700 --out " + file("out") + " " + how), 0)
        << how << errors_;
    EXPECT_EQ(errors_, "") << how;
    pictures.insert(text_of(file("out/NG.out.exr")));
  }
  EXPECT_EQ(pictures.size(), 1u);
}

TEST_F(Engines, ACachedKernelGivesWhatACompiledOneGave) {
  const std::string bake = "bake " + write("a.mtlx", waves) + " -q --size 64 --wait-for-code" +
                           " --cache " + file("cache") + " --out ";
  ASSERT_EQ(run(bake + file("first")), 0) << errors_;
  ASSERT_FALSE(names_in(file("cache")).empty());
  ASSERT_EQ(run(bake + file("second")), 0) << errors_;
  EXPECT_EQ(text_of(file("first/NG.out.exr")), text_of(file("second/NG.out.exr")));
}

TEST_F(Engines, WithoutAWorkerKernelsAreMadeHereAndThatIsSaid) {
  const std::string bake =
      "$NACRE bake " + write("a.mtlx", waves) + " -q --no-cache --size 16 --wait-for-code --out ";
  ASSERT_EQ(shell("NACRE_COMPILE_WORKER=/nonesuch " + bake + file("out")), 0) << errors_;
  EXPECT_TRUE(says("compile-failed") && says("/nonesuch")) << errors_;
}

TEST_F(Engines, CostIsSaidByNodeAndFunction) {
  const std::string document = write("a.mtlx", waves);
  ASSERT_EQ(run("inspect " + document + " --cost --json --no-cache"), 0) << errors_;
  const nlohmann::json cost = nlohmann::json::parse(printed_)[0]["cost"]["NG/out"];
  const auto all = cost["nanoseconds"].get<double>();
  EXPECT_GT(all, 0.0);
  EXPECT_GT(cost["samples"].get<int>(), 0);
  double sum = cost["outside"].get<double>();
  std::set<std::string> origins;
  for (const auto& part : cost["parts"]) {
    sum += part["nanoseconds"].get<double>();
    origins.insert(part["origin"].get<std::string>());
  }
  EXPECT_NEAR(sum, all, 1e-6 * all);
  EXPECT_TRUE(origins.contains("NG/clouds") && origins.contains("NG/wave")) << printed_;
}

TEST_F(Engines, FitsOfParametersAreShown) {
  const std::string document = write("a.mtlx", R"(<materialx version="1.39">
    <conductor_bsdf name="b" type="BSDF"><input name="ior" type="color3" value="0.2, 0.4, 1.4"/>
      <input name="extinction" type="color3" value="3.9, 2.4, 1.6"/>
      <input name="roughness" type="vector2" value="0.2, 0.2"/></conductor_bsdf>
    <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/></surface>
    <surfacematerial name="M" type="material">
      <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>
    </materialx>)");
  const std::string inspect = "inspect " + document + " --no-cache --dump program ";
  ASSERT_EQ(run(inspect + "--live"), 0) << errors_;
  EXPECT_EQ(printed_.find(" fitted "), std::string::npos);
  ASSERT_EQ(run(inspect + "--live --fit-parameters"), 0) << errors_;
  EXPECT_NE(printed_.find(" fitted "), std::string::npos);
  EXPECT_EQ(run(inspect + "--fit-parameters"), 2);
}

TEST_F(Engines, OnlyCompiledCodeHasACost) {
  EXPECT_EQ(run("inspect " + write("a.mtlx", waves) + " --cost --backend interpreter"), 1);
  EXPECT_TRUE(says("--backend jit")) << errors_;
}

}  // namespace
}  // namespace nacre
