#include "jit/graph/graph.h"

#include <gtest/gtest.h>

#include "jit/graph/prune.h"
#include "tests/jit/graph/build_text.h"

namespace nacre {
namespace {

constexpr std::string_view mixed = R"(
  <nodegraph name="NG">
    <input name="amount" type="float" value="0.5"/>
    <mix name="m" type="color3">
      <input name="fg" type="color3" value="1, 0, 0"/>
      <input name="mix" type="float" interfacename="amount"/>
    </mix>
    <output name="out" type="color3" nodename="m"/>
  </nodegraph>)";

std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  for (std::size_t at = 0; (at = result.find(from, at)) != std::string::npos; at += to.size()) {
    result.replace(at, from.size(), to);
  }
  return result;
}

TEST(TopologyHash, IgnoresParameterValuesAndNames) {
  const std::uint64_t hash = topology_hash(graph_of(mixed, {"NG/out"}));
  EXPECT_EQ(topology_hash(graph_of(replaced(mixed, "0.5", "0.7"), {"NG/out"})), hash);
  EXPECT_EQ(topology_hash(graph_of(replaced(mixed, "amount", "much"), {"NG/out"})), hash);
  EXPECT_EQ(topology_hash(graph_of(replaced(mixed, "NG", "Other"), {"Other/out"})), hash);
}

TEST(TopologyHash, SeesConnectionsAndLiterals) {
  const std::uint64_t hash = topology_hash(graph_of(mixed, {"NG/out"}));
  const auto differs = [&](std::string_view from, std::string_view to) {
    return topology_hash(graph_of(replaced(mixed, from, to), {"NG/out"})) != hash;
  };
  EXPECT_TRUE(differs("value=\"1, 0, 0\"", "value=\"1, 0, 0\" uniform=\"true\""));
  EXPECT_TRUE(differs("<input name=\"mix\" type=\"float\" interfacename=\"amount\"/>", ""));
  EXPECT_TRUE(differs("name=\"fg\"", "name=\"bg\""));
}

TEST(PrintGraph, FloatsReadBackToTheSameBits) {
  Graph graph;
  Source source;
  source.kind = Source::Kind::literal;
  source.value = {Type::vector3, {0.1f, 1.0f / 3, 1e-45f}, {}, {}};
  graph.outputs.push_back({"o", Type::vector3, source});
  EXPECT_EQ(to_string(graph), "output \"o\" vector3 = [0.1, 0.33333334, 1e-45]\n");
}

TEST(PrintGraph, QuotesText) {
  Graph graph;
  Source source;
  source.kind = Source::Kind::literal;
  source.value = {Type::string, {}, {}, {"a\"b\\c\nd"}};
  graph.outputs.push_back({"o", Type::string, source});
  EXPECT_EQ(to_string(graph), "output \"o\" string = \"a\\\"b\\\\c\\nd\"\n");
}

bool is_sound(const Graph& graph) {
  Diagnostics diagnostics;
  return verify(graph, diagnostics);
}

TEST(VerifyGraph, RefusesWhatDoesNotFit) {
  const Graph good = graph_of(mixed, {"NG/out"});
  EXPECT_TRUE(is_sound(good));
  Graph bad = good;
  bad.nodes[0].inputs[1].source.value.floats.pop_back();
  EXPECT_FALSE(is_sound(bad));
  bad = good;
  bad.nodes[0].inputs[2].type = Type::vector2;
  EXPECT_FALSE(is_sound(bad));
  bad = good;
  bad.outputs[0].source.output = 1;
  EXPECT_FALSE(is_sound(bad));
  bad = good;
  bad.nodes[0].inputs[1].source = bad.outputs[0].source;  // to itself
  EXPECT_FALSE(is_sound(bad));
  bad = good;
  bad.parameters.pop_back();
  EXPECT_FALSE(is_sound(bad));
  bad = good;
  bad.nodes[0].inputs[1].source = {};
  EXPECT_FALSE(is_sound(bad));
}

TEST(PruneGraph, DropsWhatNoOutputNeeds) {
  Graph graph = graph_of(mixed, {"NG/out"});
  const std::string before = to_string(graph);
  graph.nodes.insert(graph.nodes.begin(), graph.nodes[0]);
  graph.outputs[0].source.node = 1;
  graph.parameters.push_back(graph.parameters[0]);
  prune(graph);
  EXPECT_EQ(to_string(graph), before);
}

}  // namespace
}  // namespace nacre
