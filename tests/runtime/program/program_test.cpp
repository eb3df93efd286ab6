#include "runtime/program/program.h"

#include <gtest/gtest.h>

#include <vector>

#include "runtime/program/recorder.h"
#include "runtime/program/slice.h"
#include "runtime/value/control.h"

namespace nacre {
namespace {

Float input(Recorder& recorder, const char* name) {
  return Float(recorder.input(name, Scalar::f32));
}

Program single(Recorder& recorder, Float value) {
  const std::vector<SliceOutput> outputs{{"out", value.ref()}};
  return slice(recorder.program(), "test", outputs);
}

TEST(Recorder, FoldsLiteralsWithoutRecording) {
  const Float x = Float(2.0f) * Float(3.0f) + Float(1.0f);
  ASSERT_TRUE(x.is_constant());
  EXPECT_EQ(x.constant(), 7.0f);
}

TEST(Recorder, SharesEqualOperations) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Float y = input(recorder, "y");
  EXPECT_EQ((x * y).ref().id, (y * x).ref().id);
  EXPECT_NE((x - y).ref().id, (y - x).ref().id);
}

// What follows from one literal or another is one literal or another.
TEST(Recorder, FoldsThroughChoicesBetweenLiterals) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Bool inside = x < Float(0.0f), other = x < Float(1.0f);
  const Float eta = select(inside, Float(0.5f), Float(2.0f));
  const auto is = [&](Float value, Bool condition, float yes, float no) {
    return value.ref().id == select(condition, Float(yes), Float(no)).ref().id;
  };
  EXPECT_TRUE(is(1.0f / eta, inside, 2.0f, 0.5f));
  EXPECT_TRUE(is((eta - 1.0f) * (eta + 1.0f), inside, -0.75f, 3.0f));
  EXPECT_TRUE(is(fma(eta, eta, 1.0f), inside, 1.25f, 5.0f));
  // By another condition, or by what engines compute in their own way, no longer.
  const auto op_of = [&](Float value) {
    return recorder.program().entry().code[value.ref().id].op;
  };
  EXPECT_EQ(op_of(eta + select(other, Float(3.0f), Float(4.0f))), Op::add);
  EXPECT_EQ(op_of(exp(eta)), Op::exp);
  EXPECT_EQ(op_of(eta * x), Op::mul);
}

TEST(Recorder, AddsWhatIsTakenOnce) {
  Recorder recorder;
  const Float x = input(recorder, "x"), y = input(recorder, "y");
  EXPECT_EQ(fma(Float(1.0f), x, y).ref().id, (x + y).ref().id);
  EXPECT_EQ(fma(x, Float(1.0f), Float(0.0f)).ref().id, x.ref().id);
}

TEST(Printer, ShowsRegionsIndented) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Float y = if_any(x > Float(0.5f), x, [&] { return sqrt(x); });
  EXPECT_EQ(to_string(single(recorder, y)),
            "program test\n"
            "entry\n"
            "  %0 = f32 input x\n"
            "  %1 = f32 const 0.5\n"
            "  %2 = b1 lt %1 %0\n"
            "  if_any %2\n"
            "    %4 = f32 sqrt %0\n"
            "    %5 = f32 merge %4 %0\n"
            "  end_if\n"
            "  store out %5\n");
}

TEST(Slice, LeavesOutWhatNoOutputNeeds) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Float unused = if_any(x > Float(0.0f), x, [&] { return sqrt(input(recorder, "z")); });
  (void)unused;
  const Program program = single(recorder, x + Float(1.0f));
  EXPECT_EQ(program.inputs.size(), 1u);
  EXPECT_EQ(program.entry().code.size(), 4u);
}

TEST(Slice, CutsAtKeeps) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Float kept = Float(recorder.keep((x * x).ref()));
  const std::vector<SliceOutput> outputs{{"out", (kept + Float(1.0f)).ref()}};
  const Program cut = slice(recorder.program(), "cut", outputs, Keeps::load);
  ASSERT_EQ(cut.inputs.size(), 1u);
  EXPECT_EQ(cut.inputs[0].name, "state.0");
  const Program whole = slice(recorder.program(), "whole", outputs, Keeps::pass);
  ASSERT_EQ(whole.inputs.size(), 1u);
  EXPECT_EQ(whole.inputs[0].name, "x");
}

TEST(Varying, UniformLoopStaysUniformAndCarriesVary) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Int n(recorder.parameter("n", Scalar::i32, 3));
  Float sum = loop(recorder, Bool(true), 8, Float(0.0f), [&](Int i, Float& s) {
    s += x;
    return i + Int(1) < n;
  });
  const Program program = single(recorder, sum);
  for (const Instruction& instruction : program.entry().code) {
    if (instruction.op == Op::again) {
      EXPECT_FALSE(instruction.varying);
    }
    if (instruction.op == Op::loop) {
      EXPECT_FALSE(instruction.varying);
    }
    if (instruction.op == Op::next && instruction.type == Scalar::f32) {
      EXPECT_TRUE(instruction.varying);
    }
    if (instruction.op == Op::next && instruction.type == Scalar::i32) {
      EXPECT_FALSE(instruction.varying);
    }
  }
}

TEST(Verifier, FindsUseOutOfScope) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Float y = if_any(x > Float(0.5f), x, [&] { return sqrt(x); });
  Program program = single(recorder, y);
  // The store reads the square root inside the region instead of the merge.
  program.entry().code.back().operands[0] = 4;
  EXPECT_NE(verify(program).find("out of scope"), std::string::npos);
}

}  // namespace
}  // namespace nacre
