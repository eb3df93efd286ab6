#include "runtime/program/slice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/interpreter/interpreter.h"
#include "runtime/value/control.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

/// x + 2 x + 4 x + 8 x: what the second carries is only there for the first, what the third
/// carries for the second, what the fourth carries for nothing.
Program doubled_sum() {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Float4 last =
      loop(recorder, x > 0.0f, 4, Float4{Float(0.0f), x, x, x}, [](Int count, Float4& state) {
        state = {state.x + state.y, state.y + state.z, state.z * 2.0f, sqrt(state.w)};
        return count < Int(3);
      });
  const std::vector<SliceOutput> outputs{{"sum", last.x.ref()}};
  return slice(recorder.program(), "test", outputs);
}

TEST(Slice, KeepsWhatLoopsCarryForWhatIsNeeded) {
  const Program program = doubled_sum();
  EXPECT_EQ(verify(program), "");
  const Columns found = run(*make_interpreter(program), {{"x", {1.0f, 0.5f, -1.0f}}});
  EXPECT_EQ(found.at("sum"), (std::vector<float>{15.0f, 7.5f, 0.0f}));
}

TEST(Slice, DropsWhatNothingNeeds) {
  const Program program = doubled_sum();
  const auto is_sqrt = [](const Instruction& each) { return each.op == Op::sqrt; };
  EXPECT_EQ(std::ranges::count_if(program.entry().code, is_sqrt), 0) << to_string(program);
  // Once more changes nothing.
  Program again = program;
  remove_dead(again);
  mark_varying(again);
  EXPECT_EQ(to_string(again), to_string(program));
}

}  // namespace
}  // namespace nacre
