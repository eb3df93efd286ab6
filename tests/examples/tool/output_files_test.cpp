// No file of a command is written twice, nor over one that it reads; and what is written though it
// may not be what is wanted is said.
#include <nlohmann/json.hpp>

#include "tests/examples/tool/tool_fixture.h"

namespace nacre {
namespace {

namespace fs = std::filesystem;

/// A material of noise, and of an image that is read from `map`.exr.
std::string material(const std::string& map) {
  return R"(<materialx version="1.39" colorspace="lin_rec709"><nodegraph name="G">
    <image name="i" type="color3"><input name="file" type="filename" value=")" +
         map + R"(.exr"/></image>
    <multiply name="n" type="color3"><input name="in1" type="color3" nodename="i"/>
      <input name="in2" type="float" value="0.5"/></multiply>
    <output name="o" type="color3" nodename="n"/></nodegraph>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="G" output="o"/></standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>)";
}

const std::string noise = R"(<materialx version="1.39"><nodegraph name="N">
    <noise2d name="n" type="color3"/><output name="o" type="color3" nodename="n"/>
  </nodegraph></materialx>)";

class OutputFiles : public Tool {
 protected:
  void SetUp() override {
    Tool::SetUp();
    write("n.mtlx", noise);
    write("d.mtlx", document_);
    ASSERT_EQ(run("bake " + file("n.mtlx") + " --no-cache --size 4 --out " + file(".")), 0)
        << errors_;
    fs::rename(file("N.o.exr"), file("G.o.exr"));
  }
  /// A command fails, says why, and the files are as they were.
  void expect_kept(const std::string& command, const char* code) {
    const std::string image = text_of(file("G.o.exr"));
    EXPECT_NE(run(command), 0) << command;
    EXPECT_TRUE(says(code)) << command << "\n" << errors_;
    EXPECT_EQ(text_of(file("d.mtlx")), document_) << command;
    EXPECT_EQ(text_of(file("G.o.exr")), image) << command;
  }

  const std::string document_ = material("G.o");
};

TEST_F(OutputFiles, NoneReplacesWhatIsRead) {
  const std::string d = file("d.mtlx");
  const std::string render = "render " + d + " --no-cache --size 4 --spp 1 --out ";
  const char* const read = "[output-is-input]";
  expect_kept("tune " + d + " --no-times --profile " + d, read);
  expect_kept("tune " + d + " --no-times --plot " + file("./d.mtlx"), read);
  expect_kept(render + file("a.exr") + " --record-points " + d, read);
  expect_kept(render + file("G.o.exr"), read);
  expect_kept(render + file("G.o.exr") + " --environment " + file("G.o.exr"), read);
  expect_kept("bake " + d + " --no-cache --size 4 --out " + file("."), read);
  // By another name.
  fs::create_symlink(d, file("same.json"));
  expect_kept("tune " + d + " --no-times --profile " + file("same.json"), read);
}

TEST_F(OutputFiles, EachHasANameOfItsOwn) {
  const std::string d = file("d.mtlx"), one = file("one.json"), map = file("out/G.o.exr");
  const char* const same = "[one-name]";
  expect_kept("tune " + d + " --no-times --profile " + one + " --plot " + one, same);
  expect_kept(
      "render " + d + " --size 4 --spp 1 --out " + file("a.exr") + " --checkpoint " + file("a.exr"),
      same);
  expect_kept("bake " + d + " --size 4 --out " + file("out") + " --manifest " + map, same);
  expect_kept(
      "bake " + d + " --size 4 --document " + file("b.mtlx") + " --manifest " + file("b.mtlx"),
      same);
  EXPECT_FALSE(fs::exists(one) || fs::exists(file("b.mtlx")) || fs::exists(file("a.exr")));
}

TEST_F(OutputFiles, NumbersThatAreNoneAreSaid) {
  write("nan.mtlx", R"(<materialx version="1.39"><nodegraph name="G">
      <subtract name="n" type="float"><input name="in1" type="float" nodename="e"/>
        <input name="in2" type="float" nodename="e"/></subtract>
      <exp name="e" type="float"><input name="in" type="float" nodename="z"/></exp>
      <add name="z" type="float"><input name="in1" type="float" nodename="u"/>
        <input name="in2" type="float" value="1000"/></add>
      <extract name="u" type="float"><input name="in" type="vector2" nodename="uv"/></extract>
      <texcoord name="uv" type="vector2"/>
      <output name="o" type="float" nodename="n"/></nodegraph></materialx>)");
  EXPECT_EQ(run("bake " + file("nan.mtlx") + " --no-cache --size 4 --report --out " + file("out")),
            0);
  EXPECT_TRUE(says("[not-finite]") && says("0 infinite and 16 NaN of 16")) << errors_;
  EXPECT_NE(printed_.find("no number"), std::string::npos) << printed_;
}

TEST_F(OutputFiles, TilesThatAnImageLacksAreSaid) {
  write("tiles.mtlx", R"(<materialx version="1.39">
    <geominfo name="g"><geomprop name="udimset" type="stringarray" value="1001,1002"/></geominfo>
    <nodegraph name="G"><image name="i" type="color3">
      <input name="file" type="filename" value="t.&lt;UDIM&gt;.exr"/></image>
      <output name="o" type="color3" nodename="i"/></nodegraph></materialx>)");
  fs::copy(file("G.o.exr"), file("t.1001.exr"));
  const std::string bake =
      "bake " + file("tiles.mtlx") + " --no-cache --size 4 --out " + file("tiles") + " --udim ";
  EXPECT_EQ(run(bake + "auto"), 0) << errors_;
  EXPECT_TRUE(says("[missing-tile]") && says("found 1002")) << errors_;
  EXPECT_EQ(run(bake + "1001"), 0) << errors_;
  EXPECT_FALSE(says("[missing-tile]")) << errors_;
}

TEST_F(OutputFiles, OptionsThatMeanNothingAreRefused) {
  const std::string d = file("d.mtlx");
  const std::string bake = "bake " + d + " --no-cache --size 4 --out " + file("out") + " ";
  for (const char* const size : {"-1", "99999999999999999999", "1e30", "many"}) {
    EXPECT_EQ(run(bake + "--max-file-size " + size), 2) << size;
    EXPECT_EQ(run(bake + "--texture-memory " + size), 2) << size;
  }
  EXPECT_EQ(run(bake + "--max-file-size 64MB"), 0) << errors_;
  EXPECT_EQ(run(bake + "--working-space nope"), 1);
  EXPECT_TRUE(says("[unknown-colorspace]")) << errors_;
  EXPECT_EQ(run(bake + "--fact uv0=0.1,0.1"), 0) << errors_;
  const std::string render =
      "render " + d + " --no-cache --size 4 --spp 1 --out " + file("a.exr") + " ";
  EXPECT_EQ(run(render + "--variant x"), 1);
  EXPECT_EQ(run(render + "--animation walk"), 1);
  // What is wrong is said once: the material is one.
  EXPECT_EQ(run(render + "--material M --look nope"), 1);
  EXPECT_TRUE(says("[unknown-look]") && !says("[not-a-material]")) << errors_;
  write("empty.mtlx", "<materialx version=\"1.39\"/>");
  EXPECT_EQ(run("render " + file("empty.mtlx") + " --size 4 --spp 1 --out " + file("a.exr")), 0);
  EXPECT_TRUE(says("[no-material]")) << errors_;
}

}  // namespace
}  // namespace nacre
