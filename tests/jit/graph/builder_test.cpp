#include "jit/graph/build/builder.h"

#include <gtest/gtest.h>

#include "tests/jit/graph/build_text.h"

namespace nacre {
namespace {

Value number(float value) { return {Type::float_, {value}, {}, {}}; }

TEST(GraphBuilder, EqualsTheSameDocument) {
  GraphBuilder builder(standard_library());
  const auto amount = builder.parameter("NG/amount", number(0.5f));
  const auto mix = builder.add_node("ND_mix_color3", "NG/m");
  builder.set(mix, "fg", {Type::color3, {1, 0, 0}, {}, {}});
  builder.connect(mix, "mix", amount);
  builder.output("NG/out", mix);
  Diagnostics diagnostics;
  const auto graph = builder.finish({}, diagnostics);
  ASSERT_TRUE(graph) << diagnostics.to_string();
  EXPECT_EQ(to_string(*graph), text_of(R"(
    <nodegraph name="NG">
      <input name="amount" type="float" value="0.5"/>
      <mix name="m" type="color3">
        <input name="fg" type="color3" value="1, 0, 0" uniform="true"/>
        <input name="mix" type="float" interfacename="amount"/>
      </mix>
      <output name="out" type="color3" nodename="m"/>
    </nodegraph>)",
                                       {"NG/out"}));
}

TEST(GraphBuilder, InlinesGraphsUnderTheHostsNames) {
  GraphBuilder builder(standard_library());
  const auto separate = builder.add_node("ND_separate3_color3", "/World/Looks/split me");
  builder.output("green", separate, "outg");
  Diagnostics diagnostics;
  const auto graph = builder.finish({}, diagnostics);
  ASSERT_TRUE(graph) << diagnostics.to_string();
  ASSERT_EQ(graph->nodes.size(), 1u);
  EXPECT_EQ(graph->nodes[0].nodedef, "ND_extract_color3");
  EXPECT_TRUE(graph->nodes[0].path.starts_with("/World/Looks/split me/")) << graph->nodes[0].path;
  EXPECT_EQ(graph->outputs[0].name, "green");
}

TEST(GraphBuilder, ConvertsColourAndUnits) {
  GraphBuilder builder(standard_library());
  const auto image = builder.add_node("ND_image_color3", "i");
  builder.set(image, "file", {Type::filename, {}, {}, {"a.png"}}, "srgb_texture");
  const auto length = builder.add_node("ND_constant_float", "l");
  builder.set(length, "value", number(3), {}, "kilometer");
  builder.output("a", image);
  builder.output("b", length);
  Diagnostics diagnostics;
  const auto graph = builder.finish({}, diagnostics);
  ASSERT_TRUE(graph) << diagnostics.to_string();
  EXPECT_GT(graph->nodes.size(), 5u);
  EXPECT_NE(to_string(*graph).find("ND_constant_float(value=3000)"), std::string::npos);
}

TEST(GraphBuilder, ReportsWrongCallsByTheHostsNames) {
  const auto code_after = [](auto&& calls) {
    GraphBuilder builder(standard_library());
    calls(builder);
    Diagnostics diagnostics;
    EXPECT_FALSE(builder.finish({}, diagnostics));
    return diagnostics.all().front().code + " " + diagnostics.all().front().where.path;
  };
  EXPECT_EQ(code_after([](GraphBuilder& b) { b.add_node("ND_no", "n"); }), "unknown-nodedef n");
  EXPECT_EQ(
      code_after([](GraphBuilder& b) { b.set(b.add_node("ND_sin_float", "n"), "inn", number(1)); }),
      "unknown-input n/inn");
  EXPECT_EQ(code_after([](GraphBuilder& b) {
              b.set(b.add_node("ND_sin_float", "n"), "in", {Type::integer, {}, {1}, {}});
            }),
            "type-mismatch n/in");
  EXPECT_EQ(code_after([](GraphBuilder& b) {
              b.set(b.add_node("ND_mix_color3", "n"), "fg", {Type::color3, {1}, {}, {}});
            }),
            "bad-value n/fg");
  EXPECT_EQ(code_after([](GraphBuilder& b) {
              const auto a = b.add_node("ND_sin_float", "a");
              const auto c = b.add_node("ND_cos_float", "c");
              b.connect(a, "in", c);
              b.connect(c, "in", a);
              b.output("out", a);
            }),
            "cycle a/in");
  EXPECT_EQ(code_after([](GraphBuilder& b) {
              const auto s = b.add_node("ND_separate3_color3", "s");
              b.output("out", s);
            }),
            "output-required out");
}

}  // namespace
}  // namespace nacre
