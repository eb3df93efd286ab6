#include "jit/record/branches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <set>

#include "jit/document/read.h"
#include "jit/shading/shading_system.h"

namespace nacre {
namespace {

/// A choice between fractal3d and `other`, the sum s or a number, by `value1` > 0.5.
std::string choice(const std::string& value1, const std::string& other = R"(nodename="s")") {
  return R"(<materialx version="1.39">
    <texcoord name="uv" type="vector2"/>
    <separate2 name="p" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
    <fractal3d name="f" type="float"/>
    <add name="s" type="float">
      <input name="in1" type="float" nodename="p" output="outx"/>
      <input name="in2" type="float" nodename="p" output="outy"/>
    </add>
    <ifgreater name="c" type="float">
      <input name="value1" type="float" )" +
         value1 + R"(/>
      <input name="value2" type="float" value="0.5" uniform="true"/>
      <input name="in1" type="float" nodename="f"/>
      <input name="in2" type="float" )" +
         other + R"(/>
    </ifgreater>
    <output name="out" type="float" nodename="c"/></materialx>)";
}

class Branches : public ::testing::Test {
 protected:
  void SetUp() override {
    system_ = ShadingSystem::create({.libraries = {NACRE_MATERIALX_LIBRARIES_DIR}}, diagnostics_);
    ASSERT_NE(system_, nullptr) << diagnostics_.to_string();
  }

  std::unique_ptr<OutputKernel> compile(const std::string& text, bool lazy = true) {
    const auto document = read_document_text(text, "test.mtlx", {}, diagnostics_);
    ShaderOptions options;
    options.compile.backend = Backend::interpreter;
    options.parameters = ParameterMode::live;
    options.lazy = lazy;
    auto kernel = system_->compile_outputs(*document, {"out"}, options, diagnostics_);
    EXPECT_NE(kernel, nullptr) << diagnostics_.to_string();
    return kernel;
  }

  /// Operations of the entry that run for every point.
  static int unconditional(const OutputKernel& kernel) {
    int depth = 0;
    int count = 0;
    for (const Instruction& instruction : kernel.kernel.program().entry().code) {
      if (instruction.op == Op::end_if || instruction.op == Op::end_loop) --depth;
      if (depth == 0) ++count;
      if (instruction.op == Op::if_any || instruction.op == Op::loop) ++depth;
    }
    return count;
  }

  static int count(const OutputKernel& kernel, Op op) {
    const std::vector<Instruction>& code = kernel.kernel.program().entry().code;
    return static_cast<int>(std::count_if(code.begin(), code.end(),
                                          [op](const Instruction& one) { return one.op == op; }));
  }

  Diagnostics diagnostics_;
  std::unique_ptr<ShadingSystem> system_;
};

TEST_F(Branches, AnExpensiveSideRunsOnlyWhereItIsTaken) {
  const std::string varying = choice(R"(nodename="p" output="outx")");
  const int lazy = unconditional(*compile(varying));
  const int eager = unconditional(*compile(varying, false));
  std::cout << lazy << " operations for every point, " << eager << " with both sides\n";
  EXPECT_LT(lazy, 20);
  EXPECT_GT(eager, 2 * lazy);
}

/// A side that is known already costs nothing: the region of the other gives it. The sum costs
/// an addition and, with its own region flattened, a select.
TEST_F(Branches, AKnownSideNeedsNoSelect) {
  const std::string condition = R"(nodename="p" output="outx")";
  const auto known = compile(choice(condition, R"(nodename="p" output="outy")"));
  const auto both = compile(choice(condition));
  EXPECT_EQ(count(*known, Op::merge), 1);
  EXPECT_EQ(unconditional(*known) + 2, unconditional(*both));
}

/// A parameter that is read here first is no merge, though it is as new; the other side adds
/// nothing to what was there.
TEST_F(Branches, BothSidesMayBeKnown) {
  const auto kernel = compile(R"(<materialx version="1.39">
    <texcoord name="uv" type="vector2"/>
    <separate2 name="p" type="multioutput"><input name="in" type="vector2" nodename="uv"/></separate2>
    <add name="s" type="float"><input name="in1" type="float" nodename="p" output="outx"/>
      <input name="in2" type="float" nodename="p" output="outy"/></add>
    <ifgreater name="c" type="float">
      <input name="value1" type="float" nodename="s"/>
      <input name="value2" type="float" value="0.5" uniform="true"/>
      <input name="in1" type="float" nodename="p" output="outy"/>
      <input name="in2" type="float" value="7"/>
    </ifgreater>
    <output name="out" type="float" nodename="c"/></materialx>)");
  ASSERT_NE(kernel, nullptr);
  std::vector<std::uint32_t> parameters = kernel->kernel.parameters();
  const auto index = kernel->kernel.parameter_index("c/in2");
  ASSERT_TRUE(index);
  parameters[*index] = std::bit_cast<std::uint32_t>(9.0f);
  const std::array<float, 2> u{0.25f, 0.75f}, v{0.125f, 0.5f};
  std::vector<const void*> in;
  for (const Channel& channel : kernel->kernel.program().inputs) {
    in.push_back(channel.name == "uv0.x" ? u.data() : v.data());
  }
  std::array<float, 2> found{};
  void* out[] = {found.data()};
  ASSERT_EQ(kernel->kernel.run(in, out, 2, parameters), RunStatus::done);
  EXPECT_EQ(found, (std::array{9.0f, 0.5f}));
}

TEST_F(Branches, AUniformConditionIsABranchToo) {
  const auto kernel = compile(choice(R"(value="0")"));
  EXPECT_LT(unconditional(*kernel), 20);
  EXPECT_TRUE(kernel->kernel.parameter_index("c/value1"));
}

/// What a constant excludes is not recorded: not even its parameters are there.
TEST_F(Branches, ASideThatAConstantExcludesIsGone) {
  const std::string text = R"(<materialx version="1.39">
    <unifiednoise2d name="n" type="float">
      <input name="type" type="integer" value="TYPE" uniform="true"/>
    </unifiednoise2d>
    <output name="out" type="float" nodename="n"/></materialx>)";
  std::set<std::size_t> sizes;
  for (const char* type : {"0", "1", "2", "3"}) {
    std::string one = text;
    one.replace(one.find("TYPE"), 4, type);
    sizes.insert(instruction_count(compile(one)->kernel.program()));
  }
  EXPECT_EQ(sizes.size(), 4u);  // each is its own noise and no other

  const auto kernel = compile(R"(<materialx version="1.39">
    <constant name="a" type="float"><input name="value" type="float" value="1"/></constant>
    <constant name="b" type="float"><input name="value" type="float" value="2"/></constant>
    <ifgreater name="c" type="float">
      <input name="value1" type="float" value="1" uniform="true"/>
      <input name="value2" type="float" value="0" uniform="true"/>
      <input name="in1" type="float" nodename="a"/>
      <input name="in2" type="float" nodename="b"/>
    </ifgreater>
    <output name="out" type="float" nodename="c"/></materialx>)");
  EXPECT_TRUE(kernel->kernel.parameter_index("a/value"));
  EXPECT_FALSE(kernel->kernel.parameter_index("b/value"));
}

GraphNode node(std::string category, std::vector<std::pair<std::string, int>> links) {
  GraphNode made;
  made.category = std::move(category);
  for (const auto& [name, target] : links) {
    GraphInput input{name, Type::float_, {}};
    input.source.kind = Source::Kind::link;
    input.source.node = static_cast<std::uint32_t>(target);
    made.inputs.push_back(input);
  }
  made.outputs.push_back({"out", Type::float_, {}});
  return made;
}

/// 0 and 1 feed one side each through 2 and 3; 4 is read by both, so it is nobody's.
TEST(BranchPlan, NodesStandInTheInnermostBranchThatAllTheirReadersShare) {
  Graph graph;
  graph.nodes.push_back(node("constant", {}));
  graph.nodes.push_back(node("constant", {}));
  graph.nodes.push_back(node("constant", {}));
  graph.nodes.push_back(node("add", {{"in1", 0}, {"in2", 2}}));
  graph.nodes.push_back(node("add", {{"in1", 1}, {"in2", 2}}));
  graph.nodes.push_back(node("ifgreater", {{"value1", 2}, {"in1", 3}, {"in2", 4}}));
  GraphOutput output{"out", Type::float_, {}};
  output.source.kind = Source::Kind::link;
  output.source.node = 5;
  graph.outputs.push_back(output);
  const BranchPlan plan = plan_branches(graph);
  EXPECT_EQ(plan.branches[BranchPlan::whole].nodes, (std::vector<std::uint32_t>{2, 5}));
  const auto [first, second] = plan.of_node[5];
  EXPECT_EQ(plan.branches[first].nodes, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(plan.branches[second].nodes, (std::vector<std::uint32_t>{1, 4}));
}

/// A chain of choices as long as a document may have nodes is planned at once.
TEST(BranchPlan, DeepChainsAreLinear) {
  Graph graph;
  graph.nodes.push_back(node("constant", {}));
  for (int i = 0; i < 200'000; ++i) {
    graph.nodes.push_back(node("ifgreater", {{"value1", 0}, {"in1", i}, {"in2", 0}}));
  }
  GraphOutput output{"out", Type::float_, {}};
  output.source.kind = Source::Kind::link;
  output.source.node = 200'000;
  graph.outputs.push_back(output);
  const BranchPlan plan = plan_branches(graph);
  for (const BranchPlan::Branch& branch : plan.branches) EXPECT_LE(branch.depth, 64u);
}

}  // namespace
}  // namespace nacre
