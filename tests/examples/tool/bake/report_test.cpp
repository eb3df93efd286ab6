// What `nacre bake` tells of what it did, and how many samples it takes.
#include <nlohmann/json.hpp>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

using Json = nlohmann::json;

class BakeReport : public Tool {
 protected:
  void SetUp() override {
    write("a.mtlx",
          "<materialx version='1.39' colorspace='lin_rec709'><nodegraph name='G'>"
          "<texcoord name='t' type='vector2'/>"
          "<extract name='u' type='float'><input name='in' type='vector2' nodename='t'/></extract>"
          "<ifgreater name='i' type='integer'><input name='value1' type='float' nodename='u'/>"
          "<input name='value2' type='float' value='0.5'/><input name='in1' type='integer' "
          "value='8'/></ifgreater>"
          "<ifgreater name='e' type='float'><input name='value1' type='float' nodename='u'/>"
          "<input name='value2' type='float' value='0.40625'/><input name='in1' type='float' "
          "value='1'/><input name='in2' type='float' value='0'/></ifgreater>"
          "<constant name='c' type='color3'><input name='value' type='color3' "
          "value='0.25, 0.5, 1'/></constant>"
          "<output name='ramp' type='float' nodename='u'/>"
          "<output name='whole' type='integer' nodename='i'/>"
          "<output name='edge' type='float' nodename='e'/>"
          "<output name='plain' type='color3' nodename='c'/></nodegraph></materialx>");
  }

  std::string bake(const std::string& output) const {
    return "bake " + file("a.mtlx") + " --no-cache --output G/" + output + " --out " + file("out") +
           " ";
  }

  Json report(const std::string& arguments) {
    EXPECT_EQ(run(arguments + " --json"), 0) << errors_;
    return Json::parse(printed_);
  }
};

TEST_F(BakeReport, TellsOfARamp) {
  const Json all = report(bake("ramp") + "--size 64x2");
  ASSERT_EQ(all["files"].size(), 1u);
  const Json& map = all["files"][0];
  EXPECT_EQ(map["file"], file("out/G.ramp.exr"));
  EXPECT_EQ(map["output"], "G/ramp");
  EXPECT_EQ(map["width"], 64);
  EXPECT_EQ(map["height"], 2);
  EXPECT_EQ(map["format"], "exr");
  EXPECT_EQ(map["bits"], 32);
  EXPECT_EQ(map["samples"], 128);
  EXPECT_EQ(map["bytes"], std::filesystem::file_size(file("out/G.ramp.exr")));
  EXPECT_FALSE(map["uniform"].get<bool>());
  EXPECT_GT(map["seconds"].get<double>(), 0.0);
  EXPECT_GE(all["seconds"].get<double>(), map["seconds"].get<double>());
  const Json& channel = map["channels"][0];
  EXPECT_EQ(channel["name"], "Y");
  EXPECT_EQ(channel["min"], 0.5 / 64);
  EXPECT_EQ(channel["max"], 63.5 / 64);
  EXPECT_EQ(channel["mean"], 0.5);
  for (const Json& count : channel["histogram"]["counts"]) EXPECT_EQ(count, 4);
}

TEST_F(BakeReport, SaysWhatIsUniform) {
  const Json map = report(bake("plain") + "--size 4 --format png")["files"][0];
  EXPECT_TRUE(map["uniform"].get<bool>());
  EXPECT_EQ(map["colorspace"], "srgb_texture");
  EXPECT_EQ(map["channels"][1]["mean"], 0.5);
  EXPECT_EQ(run(bake("plain") + "--size 4 --report"), 0);
  EXPECT_NE(printed_.find("uniform"), std::string::npos) << printed_;
  EXPECT_NE(printed_.find("R: 0.25 to 0.25, mean 0.25"), std::string::npos) << printed_;
}

// An edge at 13/32: of the seventh of 16 texels the half lies on its right.
TEST_F(BakeReport, SamplesAreTheMeanOfATexel) {
  const Json map = report(bake("edge") + "--size 16 --samples 4")["files"][0];
  EXPECT_EQ(map["samples"], 4 * 256);
  EXPECT_EQ(map["channels"][0]["mean"], 1.0 - 13.0 / 32.0);
}

TEST_F(BakeReport, AutoTakesMoreWhereAnEdgeIs) {
  const Json map = report(bake("edge") + "--size 64 --samples auto --texel-error 0.01")["files"][0];
  EXPECT_GE(map["samples"].get<int>(), 4 * 64 * 64);
  EXPECT_NEAR(map["channels"][0]["mean"].get<double>(), 1.0 - 13.0 / 32.0, 0.01 / 64);
}

TEST_F(BakeReport, BytesDoNotDependOnThreads) {
  for (const std::string options :
       {"--format png", "--format png --bitdepth 16", "--format exr", "--format exr --bitdepth 16",
        "--format tx", "--format png --samples auto", "--format exr --samples 5"}) {
    std::string first;
    for (const std::string threads : {"1", "2", "7"}) {
      ASSERT_EQ(run(bake("edge") + "--size 150 --threads " + threads + " " + options), 0)
          << errors_;
      const std::string name = file("out/G.edge.") + options.substr(9, options.find(' ', 9) - 9);
      const std::string bytes = text_of(name);
      EXPECT_GT(bytes.size(), 100u) << name;
      if (first.empty()) first = bytes;
      EXPECT_TRUE(bytes == first) << options << " " << threads;
    }
  }
}

TEST_F(BakeReport, WhatHasNoMeanIsSaid) {
  EXPECT_EQ(run(bake("whole") + "--size 4 --samples 4"), 0);
  EXPECT_TRUE(says("[no-mean]")) << errors_;
  EXPECT_EQ(run(bake("whole") + "--size 4"), 0);
  EXPECT_EQ(errors_, "");
}

TEST_F(BakeReport, WhatWasNotReachedIsSaid) {
  EXPECT_EQ(run(bake("edge") + "--size 15 --samples auto --texel-error 1e-6"), 0);
  EXPECT_TRUE(says("[most-samples]")) << errors_;
}

TEST_F(BakeReport, OptionsThatCannotBeUnderstoodAreUsage) {
  for (const std::string wrong :
       {"--samples 0", "--samples -1", "--samples 4x", "--samples many", "--samples 1000000",
        "--samples 4 --texel-error 0.1", "--texel-error 0.1", "--samples auto --texel-error 0",
        "--json --report"}) {
    EXPECT_EQ(run(bake("ramp") + wrong), 2) << wrong;
    EXPECT_NE(errors_, "") << wrong;
  }
}

// A uniform input of a document is a value, and that is told.
TEST_F(BakeReport, TellsOfADocument) {
  write("m.mtlx",
        "<materialx version='1.39' colorspace='lin_rec709'><nodegraph name='G'>"
        "<texcoord name='t' type='vector2'/>"
        "<extract name='u' type='float'><input name='in' type='vector2' nodename='t'/></extract>"
        "<clamp name='k' type='float'><input name='in' type='float' nodename='u'/>"
        "<input name='low' type='float' value='2'/><input name='high' type='float' value='3'/>"
        "</clamp><output name='ramp' type='float' nodename='u'/>"
        "<output name='two' type='float' nodename='k'/></nodegraph>"
        "<standard_surface name='S' type='surfaceshader'>"
        "<input name='base' type='float' nodegraph='G' output='ramp'/>"
        "<input name='emission' type='float' nodegraph='G' output='two'/></standard_surface>"
        "<surfacematerial name='M' type='material'><input name='surfaceshader' "
        "type='surfaceshader' nodename='S'/></surfacematerial></materialx>");
  const Json all =
      report("bake " + file("m.mtlx") + " --no-cache --size 8 --document " + file("b/n.mtlx"));
  EXPECT_EQ(all["document"], file("b/n.mtlx"));
  ASSERT_EQ(all["files"].size(), 1u);
  EXPECT_EQ(all["files"][0]["output"], "S.base");
  ASSERT_EQ(all["values"].size(), 1u);
  EXPECT_EQ(all["values"][0]["input"], "S.emission");
  EXPECT_EQ(all["values"][0]["value"][0], 2.0);
}

}  // namespace
}  // namespace nacre
