#include "jit/graph/filename.h"

#include <gtest/gtest.h>

#include "tests/graph/build_text.h"

namespace nacre {
namespace {

std::optional<std::string> known(std::string_view name) {
  if (name == "kind") return "wood";
  return std::nullopt;
}

TEST(Filename, ReplacesTokensThatExist) {
  EXPECT_EQ(substitute_filename("a_[kind]_[other].png", known, {}), "a_wood_[other].png");
  EXPECT_EQ(substitute_filename("[kind][kind]", known, {}), "woodwood");
  EXPECT_EQ(substitute_filename("[kind", known, {}), "[kind");
}

TEST(Filename, KeepsWhatIsResolvedPerPoint) {
  EXPECT_EQ(substitute_filename("a.<UDIM>.<UVTILE>.<geo>.png", known, 3),
            "a.<UDIM>.<UVTILE>.<geo>.png");
}

TEST(Filename, PadsFrames) {
  EXPECT_EQ(substitute_filename("a.{frame}.exr", known, 7), "a.7.exr");
  EXPECT_EQ(substitute_filename("a.{04frame}.exr", known, 7), "a.0007.exr");
  EXPECT_EQ(substitute_filename("a.{04frame}.exr", known, 12345), "a.12345.exr");
  EXPECT_EQ(substitute_filename("a.{04frame}.exr", known, {}), "a.{04frame}.exr");
  EXPECT_EQ(substitute_filename("a.{camera}.{99frame}", known, 7), "a.{camera}.{99frame}");
}

TEST(Filename, ManyBracketsTakeLinearTime) {
  const std::string brackets(1'000'000, '[');
  EXPECT_EQ(substitute_filename(brackets, known, 1), brackets);
  EXPECT_EQ(substitute_filename("]" + brackets, known, 1), "]" + brackets);
}

std::string file_of(std::string_view body, const std::string& output,
                    std::string_view attributes = "") {
  const Graph graph = graph_of(body, {output}, {}, attributes);
  for (const GraphNode& node : graph.nodes) {
    if (const GraphInput* file = node.input("file")) return file->source.value.texts.at(0);
  }
  return "no file";
}

TEST(Filename, NearestPrefixOnly) {
  EXPECT_EQ(file_of(R"(<nodegraph name="NG" fileprefix="near/">
                         <image name="i" type="float">
                           <input name="file" type="filename" value="a.png"/>
                         </image>
                         <output name="out" type="float" nodename="i"/>
                       </nodegraph>)",
                    "NG/out", "fileprefix=\"far/\""),
            "near/a.png");
}

TEST(Filename, EmptyNamesStayEmpty) {
  EXPECT_EQ(file_of(R"(<image name="i" type="float"/>
                       <output name="out" type="float" nodename="i"/>)",
                    "out", "fileprefix=\"far/\""),
            "");
}

constexpr std::string_view textured = R"(
  <nodedef name="ND_pic" node="pic">
    <token name="kind" type="string" value="stone"/>
    <token name="ext" type="string" value="png"/>
    <output name="out" type="color3"/>
  </nodedef>
  <nodegraph name="NG_pic" nodedef="ND_pic">
    <image name="i" type="color3">
      <input name="file" type="filename" value="[kind].[ext]"/>
    </image>
    <output name="out" type="color3" nodename="i"/>
  </nodegraph>
  <pic name="plain" type="color3"/>
  <pic name="other" type="color3">
    <token name="kind" type="string" value="brick"/>
  </pic>
  <output name="plain_out" type="color3" nodename="plain"/>
  <output name="other_out" type="color3" nodename="other"/>)";

TEST(Filename, InstanceTokensOverrideThoseOfTheNodeDef) {
  EXPECT_EQ(file_of(textured, "plain_out"), "stone.png");
  EXPECT_EQ(file_of(textured, "other_out"), "brick.png");
}

TEST(Filename, InnerTokensOverrideOuterOnes) {
  EXPECT_EQ(file_of(R"(<token name="a" type="string" value="root"/>
                       <token name="b" type="string" value="root"/>
                       <nodegraph name="NG">
                         <token name="b" type="string" value="graph"/>
                         <token name="c" type="string" value="graph"/>
                         <image name="i" type="float">
                           <token name="c" type="string" value="node"/>
                           <input name="file" type="filename" value="[a]_[b]_[c]"/>
                         </image>
                         <output name="out" type="float" nodename="i"/>
                       </nodegraph>)",
                    "NG/out"),
            "root_graph_node");
}

}  // namespace
}  // namespace nacre
