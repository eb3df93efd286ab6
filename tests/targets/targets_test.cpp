// Code for CPUs that this machine need not have: LLVM must be able to make it. What LLVM
// can't select ends the process, so every failure shows.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "jit/compile/lower.h"
#include "jit/llvm/codegen.h"
#include "jit/llvm/features.h"
#include "jit/record/bodies.h"
#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/value/value.h"
#include "tests/nodes/node_runner.h"
#include "tests/pbs/battery/lobe_kernels.h"
#include "tests/support/random_program.h"
#include "tests/support/standard_library.h"

namespace nacre {
namespace {

bool full_run() { return std::getenv("NACRE_TEST_FULL") != nullptr; }

/// A generation each of what people have; then by hand what no kernel has a use for.
const std::vector<Target>& targets() {
  static const std::vector<Target> all{
      Target::named("nehalem"),
      Target::named("haswell"),
      Target::named("skylake-avx512"),
      Target::named("icelake-server"),
      Target::named("sapphirerapids"),
      Target::named("alderlake"),
      Target::named("znver2"),
      Target::named("znver3"),
      Target::named("znver4"),
      Target::named("znver5"),
      Target::named("knl"),
      {"skylake-avx512", "+avx512fp16,+avx512bf16,+gfni"},
      {"graniterapids", "+avx10.1-512,+egpr,+push2pop2"},
  };
  return all;
}

/// Compiles for every target at every width, or for a few of these, others each time.
class Compilations {
 public:
  /// Of the targets and widths one in `one_of`, unless the run is a full one.
  explicit Compilations(std::size_t one_of) : one_of_(full_run() ? 1 : one_of) {}

  void compile(const Program& program) {
    for (const Target& target : targets()) {
      for (const int lanes : {1, 4, 8, 16}) {
        if (number_++ % one_of_ != 0) continue;
        CodegenOptions options{.lanes = lanes, .target = target};
        options.tier = number_ % 3 == 0 ? Tier::quick : Tier::full;
        Diagnostics diagnostics;
        EXPECT_TRUE(compile_object(program, options, diagnostics).has_value())
            << program.name << " W=" << lanes << ' ' << target.cpu << ' ' << target.features << '\n'
            << diagnostics.to_string();
      }
    }
  }

 private:
  std::size_t one_of_;
  std::size_t number_ = 0;
};

class RandomPrograms : public testing::TestWithParam<int> {};
constexpr int shards = 16;

TEST_P(RandomPrograms, CompileForEveryTarget) {
  // One in a number that shares no factor with that of targets times widths.
  Compilations compilations(17);
  const std::uint64_t count = (full_run() ? 1000 : 240) / shards;
  const std::uint64_t first = 20240611 + count * static_cast<std::uint64_t>(GetParam());
  for (std::uint64_t k = 0; k < count; ++k) compilations.compile(random_program(first + k));
}

INSTANTIATE_TEST_SUITE_P(Shard, RandomPrograms, testing::Range(0, shards));

/// What LLVM 19 could not select with avx512fp16: a truth value as the bits of a half.
TEST(Targets, HalvesMadeOfTruthValues) {
  Recorder recorder;
  const std::vector<SliceOutput> outputs = [&] {
    std::vector<SliceOutput> list;
    for (const Ref x :
         {recorder.parameter("p", Scalar::f32, 0), recorder.input("x", Scalar::f32)}) {
      const Int bits = select(Float(x) != Float(1.5f), Int(1), Int(0));
      const Ref operand = bits.ref();
      list.push_back({list.empty() ? "uniform" : "varying",
                      recorder.emit(Op::half_to_f, std::span(&operand, 1))});
    }
    return list;
  }();
  Program program = slice(recorder.program(), "halves", outputs);
  mark_varying(program);
  Compilations(1).compile(program);
  // The smallest random Program in which it was found.
  Compilations(1).compile(random_program(20241561));
}

TEST(Targets, UseNoFeatureThatKernelsGainNothingFrom) {
  Diagnostics diagnostics;
  const Program program = random_program(20241561);
  // A target that names it by itself or by hand, and one without: the same instructions.
  const auto code = [&](const Target& target) {
    const auto object = compile_object(program, {.lanes = 16, .target = target}, diagnostics);
    return object ? object->bytes : std::vector<char>();
  };
  const std::vector<char> plain = code(Target::named("skylake-avx512"));
  EXPECT_FALSE(plain.empty());
  EXPECT_EQ(code({"skylake-avx512", "+avx512fp16,+avx512vnni,+gfni,+amx-tile"}), plain);
  EXPECT_NE(code({"skylake-avx512", "-avx512vl"}), plain);
  for (const char* cpu : {"sapphirerapids", "znver5"}) {
    const std::string ir =
        dump_ir(program, {.lanes = 16, .target = Target::named(cpu)}, diagnostics);
    EXPECT_NE(ir.find("\"tune-cpu\"=\"" + std::string(cpu) + "\""), std::string::npos);
    EXPECT_NE(ir.find("+avx512f"), std::string::npos);
    EXPECT_EQ(ir.find("fp16"), std::string::npos);
  }
  EXPECT_EQ(Target::host().features.find("fp16"), std::string::npos);
  EXPECT_EQ(diagnostics.to_string(), "");
}

// Where gathers are quick, which LLVM knows of CPUs and a host of itself.
TEST(Targets, GatherWhereThatIsQuick) {
  Recorder recorder;
  const Ref index = recorder.input("index", Scalar::i32);
  const std::vector<float> numbers(1000, 1.5f);
  const std::vector<SliceOutput> outputs{
      {"entry", recorder.emit(Op::table, std::span(&index, 1), recorder.table("t", numbers))}};
  Program program = slice(recorder.program(), "look_up", outputs);
  mark_varying(program);
  const auto gathers = [&](const Target& target, int lanes) {
    Diagnostics diagnostics;
    const std::string ir = dump_ir(program, {.lanes = lanes, .target = target}, diagnostics);
    EXPECT_NE(ir.find("load"), std::string::npos) << diagnostics.to_string();
    return ir.find("call <16 x float> @llvm.x86.avx512.mask.gather") != std::string::npos;
  };
  for (const char* cpu : {"skylake-avx512", "icelake-server", "sapphirerapids"}) {
    EXPECT_TRUE(gathers(Target::named(cpu), 16)) << cpu;
    EXPECT_FALSE(gathers({cpu, "-fast-gather"}, 16)) << cpu;
    EXPECT_FALSE(gathers({cpu, "-evex512"}, 16)) << cpu;
    EXPECT_FALSE(gathers(Target::named(cpu), 8)) << cpu;
  }
  for (const char* cpu : {"znver4", "znver5", "haswell", "alderlake"}) {
    EXPECT_FALSE(gathers(Target::named(cpu), 16)) << cpu;
  }
  // What Linux 6.6 has for each state.
  for (const char* quick : {"Not affected", "Vulnerable", "Vulnerable: No microcode"}) {
    EXPECT_TRUE(codegen::gathers_are_not_slowed(quick)) << quick;
  }
  for (const char* slow :
       {"Mitigation: Microcode", "Mitigation: Microcode (locked)",
        "Mitigation: AVX disabled, no microcode", "Unknown: Dependent on hypervisor status", ""}) {
    EXPECT_FALSE(codegen::gathers_are_not_slowed(slow)) << slow;
  }
}

/// The widest lanes need all of AVX-512: the first CPUs had less, others have it for 256 bits.
TEST(Targets, PartsOfAvx512AreNotUsed) {
  EXPECT_EQ(widest_lanes(Target::named("nehalem")), 4);
  EXPECT_EQ(widest_lanes(Target::named("haswell")), 8);
  EXPECT_EQ(widest_lanes(Target::named("knl")), 8);
  EXPECT_EQ(widest_lanes(Target::named("znver4")), 16);
  EXPECT_EQ(widest_lanes({"znver4", "-evex512"}), 8);
}

bool is_value(Type type) { return is_numeric(type) || is_text(type); }

TEST(Targets, TakeEveryNode) {
  Compilations compilations(17);
  const Bodies bodies(standard_library().definitions());
  std::size_t nodes = 0;
  for (const NodeDef* def : standard_library().definitions().all()) {
    const bool values = std::ranges::all_of(
        def->outputs, [](const NodeDefOutput& output) { return is_numeric(output.type); });
    const bool numbers = std::ranges::all_of(
        def->inputs, [](const NodeDefInput& input) { return is_value(input.type); });
    const bool images = std::ranges::any_of(def->inputs, [](const NodeDefInput& input) {
      return input.type == Type::filename && input.name == "file";
    });
    if (!values || !numbers || images || !bodies.contains(def->name)) continue;
    NodeUnderTest node{def->category, {}, {}};
    for (const NodeDefInput& input : def->inputs) {
      node.inputs.push_back({std::string(input.name), input.type, "object"});
    }
    for (const NodeDefOutput& output : def->outputs) {
      node.outputs.push_back({std::string(output.name), output.type});
    }
    ++nodes;
    const Accuracy accuracy = nodes % 2 == 0 ? Accuracy::standard : Accuracy::precise;
    compilations.compile(lower(node_program(node), {.accuracy = accuracy}));
  }
  EXPECT_GT(nodes, 400u);
}

TEST(Targets, TakeEveryLobe) {
  Compilations compilations(17);
  for (const LobeCase& row : lobe_cases()) {
    LobePrograms programs = lobe_programs(row, Accuracy::standard);
    for (Program* program : {&programs.evaluate, &programs.sample, &programs.albedo}) {
      compilations.compile(lower(std::move(*program), {}));
    }
  }
}

}  // namespace
}  // namespace nacre
