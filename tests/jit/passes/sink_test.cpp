// What only regions need is computed in them, and no bit of a result changes.

#include "jit/passes/sink.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "runtime/interpreter/interpreter.h"
#include "runtime/program/parse.h"
#include "runtime/program/program.h"
#include "tests/support/random_program.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

/// A Program that begins with inputs x and y and parameters p and q.
Program program_of(const std::string& body, const std::string& tables) {
  const std::string text =
      "program test\nparameter f32 p = 1\nparameter f32 q = 1\n" + tables +
      "entry\n"
      "  %0 = f32 input x\n  %1 = f32 input y\n  %2 = f32 param p\n  %3 = f32 param q\n" +
      body;
  Diagnostics diagnostics;
  std::optional<Program> program = parse_program(text, diagnostics);
  EXPECT_TRUE(program) << diagnostics.to_string() << text;
  return program.value_or(Program());
}

/// The entry, an operation a word: "input if_any( mul merge ) store".
std::string sunk(const std::string& body, const std::string& tables = "") {
  const Program result = sink(program_of(body, tables));
  EXPECT_EQ(verify(result), "");
  std::string words;
  for (const Instruction& instruction : result.entry().code) {
    const Op op = instruction.op;
    if (op == Op::parameter || op == Op::constant) continue;
    if (!words.empty()) words += ' ';
    words += closes_region(op) ? ")" : std::string(info(op).name) + (opens_region(op) ? "(" : "");
  }
  return words;
}

// Every operation and structure there is.
TEST(Sink, KeepsTheBitsOfWhatProgramsCompute) {
  constexpr std::uint64_t programs = 600;
  std::vector<std::uint32_t> order(64);
  std::iota(order.begin(), order.end(), 0u);
  std::size_t changed = 0;
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    Program program = random_program(seed);
    mark_varying(program);
    const Program result = sink(program);
    ASSERT_EQ(verify(result), "") << "seed " << seed << '\n' << to_string(program);
    changed += to_string(result) != to_string(program) ? 1u : 0u;
    const RandomBatch batch(program, seed, order);
    ASSERT_EQ(batch.run(*make_interpreter(result), 0, order.size()),
              batch.run(*make_interpreter(program), 0, order.size()))
        << "seed " << seed << '\n'
        << to_string(program) << to_string(result);
  }
  EXPECT_GT(changed, programs / 10);
}

TEST(Sink, WhatOneRegionNeedsIsComputedThere) {
  EXPECT_EQ(sunk(R"(  %4 = f32 mul %0 %1
  %5 = b1 lt %0 %2
  if_any %5
    %7 = f32 sqrt %4
    %8 = f32 merge %7 %0
  end_if
  store z %8
)"),
            "input lt if_any( input mul sqrt merge ) store");
}

TEST(Sink, WhatLanesHaveThatDoNotEnterStays) {
  EXPECT_EQ(sunk(R"(  %4 = f32 mul %0 %1
  %5 = b1 lt %0 %2
  if_any %5
    %7 = f32 sqrt %4
    %8 = f32 merge %7 %4
  end_if
  store z %8
)"),
            "input input mul lt if_any( sqrt merge ) store");
}

TEST(Sink, TheInnermostRegionIsFound) {
  EXPECT_EQ(sunk(R"(  %4 = f32 mul %0 %1
  %5 = b1 lt %0 %2
  %6 = b1 lt %0 %3
  if_any %5
    if_any %6
      %9 = f32 sqrt %4
      %10 = f32 merge %9 %0
    end_if
    %12 = f32 merge %10 %0
  end_if
  store z %12
)"),
            "input lt if_any( lt if_any( input mul sqrt merge ) merge ) store");
}

/// Two ways, by parameters or by what differs from point to point.
std::string two_ways(const std::string& left) {
  return R"(  %4 = f32 mul %0 %1
  %5 = b1 lt )" +
         left + R"( %2
  %6 = b1 lt %2 )" +
         left + R"(
  if_any %5
    %8 = f32 sqrt %4
    %9 = f32 merge %8 %0
  end_if
  if_any %6
    %12 = f32 abs %4
    %13 = f32 merge %12 %9
  end_if
  store z %13
)";
}

TEST(Sink, WhatTwoWaysNeedIsComputedInEachWhereOneIsTaken) {
  EXPECT_EQ(sunk(two_ways("%3")),
            "input lt lt if_any( input mul sqrt merge ) if_any( input mul abs merge ) store");
  EXPECT_EQ(sunk(two_ways("%0")),
            "input input mul lt lt if_any( sqrt merge ) if_any( abs merge ) store");
}

TEST(Sink, NothingIsComputedAgainInEachRoundOfALoop) {
  EXPECT_EQ(sunk(R"(  %4 = f32 mul %0 %1
  %5 = b1 const true
  loop 4 %5
    %7 = f32 carry %0
    %8 = f32 add %7 %4
    %9 = b1 lt %8 %2
    %10 = f32 next %7 %8
    again %9
  end_loop
  store z %10
)"),
            "input input mul loop( carry add lt next again ) store");
}

TEST(Sink, NeighboursInATableAreReadTogether) {
  const std::string body = R"(  %4 = i32 f_to_i %0
  %5 = i32 const 1
  %6 = i32 iadd %4 %5
  %7 = f32 table steps %4
  %8 = f32 table steps %6
  %9 = b1 lt %7 %2
  if_any %9
    %11 = f32 sqrt %8
    %12 = f32 merge %11 %7
  end_if
  store z %12
)";
  EXPECT_EQ(sunk(body, "table steps = 1 2 3\n"),
            "input input f_to_i iadd table table lt if_any( sqrt merge ) store");
}

TEST(Sink, WhatIsOfACallStays) {
  EXPECT_EQ(sunk(R"(  %4 = f32 mul %2 %3
  %5 = b1 lt %0 %2
  if_any %5
    %7 = f32 add %4 %0
    %8 = f32 merge %7 %0
  end_if
  store z %8
)"),
            "input input mul lt if_any( add merge ) store");
}

}  // namespace
}  // namespace nacre
