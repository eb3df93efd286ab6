// Loops that do not end, in every engine, and lanes that must not be asked about them.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <initializer_list>

#include "runtime/interpreter/interpreter.h"
#include "runtime/program/cost.h"
#include "runtime/value/control.h"
#include "tests/jit/glsl/run_text.h"

namespace nacre {
namespace {

struct Ended {
  RunStatus status;
  std::vector<float> values;
};

/// Runs a Program of input "a0" and output "result" over points.
Ended run_points(const Kernel& kernel, const std::vector<float>& points,
                 const std::atomic<std::uint32_t>* stop = nullptr) {
  Ended ended{RunStatus::done, std::vector<float>(points.size())};
  const std::vector<const void*> in(kernel.program().inputs.size(), points.data());
  void* out = ended.values.data();
  ended.status =
      kernel.run({.inputs = in.data(), .outputs = &out, .count = points.size(), .stop = stop});
  return ended;
}

Program program_of(const std::string& text) {
  TextRun run = run_text(text, {{0.5f}});
  EXPECT_FALSE(run.diagnostics.has_errors()) << run.diagnostics.to_string();
  return run.program;
}

const std::string halves = R"(
float halves(float x) { float n = 0.0; while (x < 100.0) { x *= 2.0; n += 1.0; } return n; })";

TEST(GlslLoops, OneThatDoesNotEndIsAnError) {
  const Program program = program_of(halves + "float f(float x) { return halves(x); }");
  const auto reference = make_reference(program);
  const auto interpreter = make_interpreter(program);
  for (const Kernel* kernel :
       std::initializer_list<const Kernel*>{reference.get(), interpreter.get()}) {
    const Ended good = run_points(*kernel, {1, 2, 50, 200});
    EXPECT_EQ(good.status, RunStatus::done) << kernel->engine();
    EXPECT_EQ(good.values, (std::vector<float>{7, 6, 1, 0})) << kernel->engine();
    EXPECT_EQ(run_points(*kernel, {1, 2, 0, 200}).status, RunStatus::too_many_steps)
        << kernel->engine();
  }
}

TEST(GlslLoops, RoundsThatAreKnownAreNoQuestion) {
  const Program program = program_of(
      "float f(float x) { for (int i = 0; i < 1024; i++) x = fract(x * 1.5 + 0.1); return x; }");
  EXPECT_NE(to_string(program).find("loop 1024 "), std::string::npos) << to_string(program);
  EXPECT_EQ(run_points(*make_interpreter(program), {0.25f}).status, RunStatus::done);
  const Program more = program_of(
      "float f(float x) { for (int i = 0; i < 1025; i++) x = fract(x * 1.5 + 0.1); return x; }");
  EXPECT_EQ(run_points(*make_interpreter(more), {0.25f}).status, RunStatus::too_many_steps);
}

/// The loop would not end for 0, but 0 does not get there, in one way or another.
TEST(GlslLoops, OnlyLanesThatNeedThemCount) {
  // Large enough to be recorded once and called.
  std::string large = "float large(float x) { float n = halves(x);\n";
  for (int i = 0; i < 200; ++i) large += "n = fract(n * 1.5 + x);\n";
  large += "return n; }\n";
  for (const std::string body : {
           "if (x > 0.0) return halves(x); return -1.0;",
           "float y = -1.0; if (x > 0.0) { y = halves(x); } return y;",
           "return x > 0.0 ? halves(x) : -1.0;",
           "return x > 0.0 && halves(x) > 3.0 ? 1.0 : -1.0;",
           "float y = -1.0; if (x > 0.0) { y = large(x); } return y;",
           "float y = x; for (int i = 0; i < 70; i++) { if (x <= 0.0) break; y += halves(x) + "
           "halves(fract(y) + 0.5); } return y;",
           "float y = x; float z = x; while (z > 0.0) { y += halves(z); z -= 0.25; } return y;",
           "float y = x; float z = x; do { if (z <= 0.0) break; y += large(z); z -= 0.25; } while "
           "(true); return y;",
       }) {
    const Program program = program_of(halves + large + "float f(float x) {" + body + "}");
    const auto kernel = make_interpreter(program);
    std::vector<float> points{0.0f, 0.5f, -1.0f, 3.0f, 0.25f};
    const Ended ended = run_points(*kernel, points);
    EXPECT_EQ(ended.status, RunStatus::done) << body << to_string(program);
    // Together as alone.
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(run_points(*kernel, {points[i]}).values[0], ended.values[i]) << body;
    }
  }
}

/// Points beyond the batch are nobody's: 0, which fills registers, would never end.
TEST(GlslLoops, NoPointsButThoseAskedFor) {
  const auto kernel =
      make_interpreter(program_of(halves + "float f(float x) { return halves(x); }"));
  for (const std::size_t count : {1u, 3u, 17u, 100u}) {
    EXPECT_EQ(run_points(*kernel, std::vector<float>(count, 3.0f)).status, RunStatus::done);
  }
}

const std::string nest = R"(float f(float x) {
  float s = x;
  for (int i = 0; i < 1024; i++) for (int j = 0; j < 1024; j++) for (int k = 0; k < 1024; k++)
    s = fract(s * 1.1 + float(i + j + k));
  return s; })";

TEST(GlslLoops, NestsEnd) {
  const Program program = program_of(nest);
  EXPECT_TRUE(StepLimit(program, default_max_steps).is_counted());
  const auto reference = make_reference(program);
  const auto interpreter = make_interpreter(program);
  EXPECT_EQ(run_points(*reference, {0.5f}).status, RunStatus::too_many_steps);
  EXPECT_EQ(run_points(*interpreter, {0.5f}).status, RunStatus::too_many_steps);
  // One that asks to stop is heard within the nest.
  const std::atomic<std::uint32_t> stop = 1;
  EXPECT_EQ(run_points(*make_interpreter(program, std::uint64_t{1} << 60), {0.5f}, &stop).status,
            RunStatus::stopped);
}

TEST(GlslLoops, HonestNestsAreNotCounted) {
  // 16 rounds each, known from the text: 4,096 rounds of a noise.
  const Program program = program_of(R"(float f(float x) {
  float s = 0.0;
  for (int i = 0; i < 16; i++) for (int j = 0; j < 16; j++) for (int k = 0; k < 16; k++) {
    vec3 p = vec3(x + float(i), float(j), float(k));
    s += fract(sin(dot(p, vec3(12.9898, 78.233, 37.719))) * 43758.5453) / 4096.0;
  }
  return s; })");
  EXPECT_FALSE(StepLimit(program, default_max_steps).is_counted());
  EXPECT_EQ(run_points(*make_reference(program), {0.5f}).status, RunStatus::done);
}

TEST(GlslLoops, CostsOfCallTrees) {
  std::string text = "float g0(float x) { return x; }\n";
  for (int i = 1; i < 50; ++i) {
    const std::string before = "g" + std::to_string(i - 1);
    text += "float g" + std::to_string(i) + "(float x) { return " + before + "(x) + " + before +
            "(x * 1.1); }\n";
  }
  Diagnostics diagnostics;
  const auto module = glsl::Module::read(
      glsl::Prelude::read(), {"text.glsl", text + "float f(float x) { return g49(x); }"}, {},
      diagnostics);
  ASSERT_NE(module, nullptr);
  Recorder recorder;
  const auto result = module->record(*module->function("f"), {glsl::make(input(recorder, "a0"))},
                                     recorder, diagnostics);
  ASSERT_TRUE(result) << diagnostics.to_string();
  const Program program = slice(recorder.program(), "text",
                                std::vector<SliceOutput>{{"result", result->value.parts[0]}});
  const double once = function_costs(program).front().once;
  EXPECT_GT(once, std::ldexp(1.0, 45));
  EXPECT_LT(once, std::ldexp(1.0, 53));
}

/// Costs by hand: an instruction that is no constant is a step.
TEST(Cost, IsTheSumOfWhatRuns) {
  Recorder recorder;
  const Float x = input(recorder, "a0");
  const Float y = loop(recorder, x > 0.0f, 10, x, [&](Int, Float& state) {
    state = state * state;
    state = loop(recorder, Bool(true), 5, state, [](Int, Float& inner) {
      inner = inner + 1.0f;
      return Bool(true);
    });
    return state < 100.0f;
  });
  const Program program =
      slice(recorder.program(), "t", std::vector<SliceOutput>{{"result", y.ref()}});
  const FunctionCost cost = function_costs(program).front();
  ASSERT_EQ(cost.rounds.size(), 2u) << to_string(program);
  const double outer = cost.rounds.begin()->second;
  const double inner = cost.rounds.rbegin()->second;
  EXPECT_EQ(cost.once, cost.straight + outer + inner);
  EXPECT_EQ(cost.most, cost.straight + 10 * outer + 50 * inner);
  EXPECT_FALSE(StepLimit(program, static_cast<std::uint64_t>(cost.most)).is_counted());
  EXPECT_TRUE(StepLimit(program, static_cast<std::uint64_t>(cost.most) - 1).is_counted());
  // Bounds that are rounds wanted, not limits: nothing to fail by.
  EXPECT_FALSE(StepLimit(program, default_max_steps).can_fail());
}

}  // namespace
}  // namespace nacre
