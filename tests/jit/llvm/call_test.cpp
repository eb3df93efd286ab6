#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/interpreter/interpreter.h"
#include "runtime/program/slice.h"
#include "runtime/value/control.h"
#include "tests/jit/llvm/engine.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

/// scale * sqrt(x) + scale / 3, twice: by a number that is the same for all points both
/// times, or only the first time.
Program two_calls(bool second_varies) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const auto parameter = [&](const char* name, float value) {
    return Float(recorder.parameter(name, Scalar::f32, std::bit_cast<std::uint32_t>(value)));
  };
  const auto body = [](Float at, Float scale) { return scale * sqrt(at) + scale / Float(3.0f); };
  const Float second = second_varies ? x + Float(1.0f) : parameter("b", -0.7f);
  const Float a = outline<Float>(recorder, "scaled", body, x, parameter("a", 1.3f));
  const Float b = outline<Float>(recorder, "scaled", body, x * x, second);
  const std::vector<SliceOutput> outputs{{"out", (a - b).ref()}};
  Program program = slice(recorder.program(), "calls", outputs);
  mark_varying(program);
  return program;
}

TEST(Call, ArgumentsThatNoCallVariesAreUniform) {
  const Program same = two_calls(false);
  ASSERT_EQ(same.functions.size(), 2u) << to_string(same);
  EXPECT_EQ(uniform_arguments(same.functions[1]), (std::vector<bool>{false, true}));
  const Program varies = two_calls(true);
  ASSERT_EQ(varies.functions.size(), 2u) << to_string(varies);
  EXPECT_EQ(uniform_arguments(varies.functions[1]), (std::vector<bool>{false, false}));
}

TEST(Call, BitsDoNotDependOnWhatIsUniform) {
  Columns in;
  for (int i = 0; i < 37; ++i) in["x"].push_back(0.37f * static_cast<float>(i));
  for (const bool second_varies : {false, true}) {
    const Program program = two_calls(second_varies);
    const Columns expected = run(*make_interpreter(program), in);
    for (const int lanes : {1, 4, 8, 16}) {
      const auto kernel = compiled(program, {.lanes = lanes});
      ASSERT_NE(kernel, nullptr);
      EXPECT_EQ(run(*kernel, in), expected) << lanes;
    }
  }
}

}  // namespace
}  // namespace nacre
