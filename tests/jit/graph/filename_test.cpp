#include "jit/graph/resolve/filename.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/jit/graph/build_text.h"

namespace nacre {
namespace {

std::optional<std::string> known(std::string_view name) {
  if (name == "kind") return "wood";
  return std::nullopt;
}

const FilenameSubstitutions tokens{.token = known, .attribute = {}, .geometry = {}};

TEST(Filename, ReplacesTokensThatExist) {
  EXPECT_EQ(substitute_filename("a_[kind]_[other].png", tokens), "a_wood_[other].png");
  EXPECT_EQ(substitute_filename("[kind][kind]", tokens), "woodwood");
  EXPECT_EQ(substitute_filename("[kind", tokens), "[kind");
}

TEST(Filename, EachKindOfBracketHasItsOwnNames) {
  const FilenameSubstitutions by{
      .token = known,
      .attribute = [](std::string_view name) -> std::optional<std::string> {
        return name == "show" ? std::optional<std::string>("mx") : std::nullopt;
      },
      .geometry = [](std::string_view name) -> std::optional<std::string> {
        return name == "txtid" ? std::optional<std::string>("Lengine") : std::nullopt;
      }};
  EXPECT_EQ(substitute_filename("/{show}/<txtid>/[kind]", by), "/mx/Lengine/wood");
  EXPECT_EQ(substitute_filename("{kind}<show>[txtid]", by), "{kind}<show>[txtid]");
}

TEST(Filename, KeepsWhatIsResolvedLater) {
  EXPECT_EQ(substitute_filename("a.<UDIM>.<UVTILE>.<geo>.{04frame}.png", tokens),
            "a.<UDIM>.<UVTILE>.<geo>.{04frame}.png");
}

TEST(Filename, PadsFrames) {
  EXPECT_EQ(substitute_frame("a.{frame}.exr", 7), "a.7.exr");
  EXPECT_EQ(substitute_frame("a.{04frame}.exr", 7), "a.0007.exr");
  EXPECT_EQ(substitute_frame("a.{04frame}.exr", 12345), "a.12345.exr");
  EXPECT_EQ(substitute_frame("a.{camera}.{99frame}<frame>", 7), "a.{camera}.{99frame}<frame>");
  EXPECT_TRUE(has_frame_token("a.{04frame}.exr"));
  EXPECT_FALSE(has_frame_token("a.{camera}.exr"));
}

TEST(Filename, ManyBracketsTakeLinearTime) {
  const std::string brackets(1'000'000, '[');
  EXPECT_EQ(substitute_filename(brackets, tokens), brackets);
  EXPECT_EQ(substitute_filename("]" + brackets, tokens), "]" + brackets);
}

TEST(FrameRange, IsTwoNumbersInOrder) {
  ASSERT_TRUE(parse_frame_range("10-99"));
  EXPECT_EQ(parse_frame_range("10-99")->first, 10);
  EXPECT_EQ(parse_frame_range("10-99")->last, 99);
  EXPECT_EQ(parse_frame_range("-5-5")->first, -5);
  for (const char* wrong : {"", "10", "10-", "-", "99-10", "1-2x", "a-b", "1-99999999999"}) {
    EXPECT_FALSE(parse_frame_range(wrong)) << wrong;
  }
}

/// Standard Nodes, "Texture Node Notes": inside the range nothing is done.
TEST(FrameRange, EndActionsAreAsWritten) {
  const FrameRange range{10, 13};
  for (const char* action : {"constant", "clamp", "periodic", "mirror"}) {
    for (int frame = 10; frame <= 13; ++frame)
      EXPECT_EQ(frame_in_range(frame, range, action), frame);
  }
  EXPECT_FALSE(frame_in_range(9, range, "constant"));
  EXPECT_FALSE(frame_in_range(14, range, ""));
  EXPECT_EQ(frame_in_range(-1000, range, "clamp"), 10);
  EXPECT_EQ(frame_in_range(14, range, "clamp"), 13);
  const std::vector<int> periodic{12, 13, 10, 11, 12, 13, 10, 11};
  const std::vector<int> mirrored{12, 11, 10, 11, 12, 13, 12, 11};
  for (int i = 0; i < 8; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_EQ(frame_in_range(8 + i, range, "periodic"), periodic[k]) << i;
    EXPECT_EQ(frame_in_range(8 + i, range, "mirror"), mirrored[k]) << i;
  }
  EXPECT_EQ(frame_in_range(7, {3, 3}, "mirror"), 3);
  EXPECT_EQ(frame_in_range(std::numeric_limits<int>::max(),
                           {std::numeric_limits<int>::min(), std::numeric_limits<int>::min() + 1},
                           "periodic"),
            std::numeric_limits<int>::min() + 1);
}

std::string file_of(std::string_view body, const std::string& output,
                    std::string_view attributes = "", const GraphOptions& options = {}) {
  const Graph graph = graph_of(body, {output}, options, attributes);
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

TEST(Filename, TexturesChooseTheirFrame) {
  const auto file = [](std::string_view inputs, int frame) {
    GraphOptions options;
    options.frame = frame;
    const std::string body =
        R"(<image name="i" type="float">
             <input name="file" type="filename" value="a.{04frame}.exr"/>)" +
        std::string(inputs) + R"(</image><output name="out" type="float" nodename="i"/>)";
    return file_of(body, "out", "", options);
  };
  EXPECT_EQ(file("", 7), "a.0007.exr");
  EXPECT_EQ(file(R"(<input name="frameoffset" type="integer" value="25"/>)", 100), "a.0125.exr");
  constexpr std::string_view range = R"(<input name="framerange" type="string" value="1-10"/>)";
  EXPECT_EQ(file(range, 10), "a.0010.exr");
  EXPECT_EQ(file(range, 11), "");  // constant: the node's default
  const auto with = [&](std::string_view action) {
    return std::string(range) + "<input name=\"frameendaction\" type=\"string\" value=\"" +
           std::string(action) + "\"/>";
  };
  EXPECT_EQ(file(with("clamp"), 11), "a.0010.exr");
  EXPECT_EQ(file(with("periodic"), 11), "a.0001.exr");
  EXPECT_EQ(file(with("mirror"), 11), "a.0009.exr");
}

// The graph of tiledimage hands its own inputs on.
TEST(Filename, GraphsHandFramesOn) {
  GraphOptions options;
  options.frame = 3;
  EXPECT_EQ(file_of(R"(<tiledimage name="i" type="color3">
                         <input name="file" type="filename" value="a.{frame}.exr"/>
                         <input name="framerange" type="string" value="5-6"/>
                         <input name="frameendaction" type="string" value="clamp"/>
                       </tiledimage>
                       <output name="out" type="color3" nodename="i"/>)",
                    "out", "", options),
            "a.5.exr");
}

TEST(Filename, HostsNameAttributesAndGeometryTokens) {
  GraphOptions options;
  options.host_attributes["show"] = "mx";
  options.geometry_tokens["txtid"] = "Lengine";
  EXPECT_EQ(file_of(R"(<image name="i" type="float">
                         <input name="file" type="filename" value="{show}/{shot}/<txtid>.<UDIM>.exr"/>
                       </image>
                       <output name="out" type="float" nodename="i"/>)",
                    "out", "", options),
            "mx/{shot}/Lengine.<UDIM>.exr");
}

}  // namespace
}  // namespace nacre
