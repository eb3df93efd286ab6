#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "runtime/program/parse.h"

namespace nacre {
namespace {

/// What the verifier says of a printed Program; empty if it is valid.
std::string fault_of(std::string_view text) {
  Diagnostics diagnostics;
  if (parse_program(text, diagnostics).has_value()) return {};
  const Diagnostic& diagnostic = diagnostics.all().front();
  return diagnostic.code == "program-invalid" ? diagnostic.found : diagnostic.to_string();
}

TEST(Verify, AcceptsRegionsThatAreClosedAndFedFromOutside) {
  EXPECT_EQ(fault_of("entry\n"
                     "  %0 = f32 input x\n"
                     "  %1 = b1 lt %0 %0\n"
                     "  if_any %1\n"
                     "    %3 = f32 sqrt %0\n"
                     "    %4 = f32 const 2\n"
                     "    %5 = f32 merge %3 %4\n"
                     "    %6 = f32 merge %3 %0\n"
                     "  end_if\n"
                     "  loop 4 %1\n"
                     "    %9 = f32 carry %5\n"
                     "    %10 = f32 add %9 %0\n"
                     "    %11 = f32 next %9 %10\n"
                     "    again %1\n"
                     "  end_loop\n"
                     "  store out %11\n"),
            "");
}

TEST(Verify, OuterOperandOfAMergeIsFromOutsideItsRegion) {
  const std::string opening =
      "entry\n"
      "  %0 = f32 input x\n"
      "  %1 = b1 lt %0 %0\n"
      "  if_any %1\n"
      "    %3 = f32 sqrt %0\n";
  EXPECT_EQ(fault_of(opening + "    %4 = f32 merge %0 %3\n  end_if\n  store out %4\n"),
            "entry %4 merge: operand 1 is not from outside the region");
  // Another merge is visible after the region, but there is none if it is skipped.
  EXPECT_EQ(fault_of(opening + "    %4 = f32 merge %3 %0\n    %5 = f32 merge %3 %4\n  end_if\n"
                               "  store out %5\n"),
            "entry %5 merge: operand 1 is not from outside the region");
}

TEST(Verify, CarryStartsFromOutsideAndNextIsOfItsOwnLoop) {
  const std::string opening =
      "entry\n"
      "  %0 = f32 input x\n"
      "  %1 = b1 lt %0 %0\n"
      "  loop 4 %1\n";
  EXPECT_EQ(fault_of(opening + "    %3 = f32 sqrt %0\n    %4 = f32 carry %3\n    again %1\n"
                               "  end_loop\n"),
            "entry %4 carry: operand 0 is not from outside the region");
  EXPECT_EQ(fault_of(opening + "    %3 = f32 carry %0\n    loop 4 %1\n"
                               "      %5 = f32 next %3 %0\n      again %1\n    end_loop\n"
                               "    again %1\n  end_loop\n"),
            "entry %5 next: not of a carry of this loop");
  EXPECT_EQ(fault_of(opening + "    %3 = f32 next %0 %0\n    again %1\n  end_loop\n"),
            "entry %3 next: not of a carry");
}

TEST(Verify, RefusesEverythingElseThatEnginesRelyOn) {
  struct Case {
    const char* text;
    const char* fault;
  };
  const std::vector<Case> cases{
      {"entry\n  %0 = i32 input n\n  %1 = f32 sqrt %0\n",
       "entry %1 sqrt: operand 0 is i32, not f32"},
      {"entry\n  %0 = f32 input x\n  %1 = f32 add %0\n", "entry %1 add: wrong number of operands"},
      {"entry\n  %0 = f32 input x\n  %1 = i32 add %0 %0\n", "entry %1 add: wrong result type"},
      {"entry\n  %0 = f32 input x\n  %1 = b1 input y\n  %2 = i32 select %1 %0 %0\n",
       "entry %2 select: result type is not that of the operands"},
      {"entry\n  %0 = b1 input m\n  if_any %0\n    %2 = f32 input x\n  end_if\n  store o %2\n",
       "entry %4 store: operand 0 is out of scope"},
      {"entry\n  %0 = b1 input m\n  if_any %0\n    store o %0\n  end_if\n",
       "entry %2 store: inside a region"},
      {"entry\n  %0 = b1 input m\n  if_any %0\n", "entry: a region is not closed"},
      {"entry\n  end_if\n", "entry %0 end_if: closes no if_any"},
      {"entry\n  %0 = b1 input m\n  loop 3 %0\n  end_loop\n",
       "entry %2 end_loop: closes no loop with an again"},
      {"entry\n  %0 = b1 input m\n  loop 3 %0\n    again %0\n    %3 = f32 input x\n  end_loop\n",
       "entry %2 again: not last in its loop"},
      {"entry\n  %0 = f32 input x\n  %1 = i32 input x\n",
       "entry %1 input: not of the declared type"},
      {"entry\n  %0 = f32 input x\n  %1 = f32 ddx 2 %0\n",
       "entry %1 ddx: no axis of the footprint"},
      {"table t =\nentry\n  %0 = i32 input n\n  %1 = f32 table t %0\n",
       "entry %1 table: empty table"},
      {"function @f.1()\n  %0 = f32 input x\n  give 0 %0\nentry\n",
       "f %0 input: input in a function"},
      {"function @f.1()\n  %0 = call @f.1\n  %1 = f32 result 0 %0\n  give 0 %1\nentry\n",
       "f %0 call: calls a function that does not stand before"},
      {"function @f.1(f32)\n  %0 = f32 arg 1\n  give 0 %0\nentry\n",
       "f %0 arg: index out of range"},
      {"function @f.1(f32)\n  %0 = f32 arg 0\n  give 0 %0\nentry\n  %0 = call @f.1\n",
       "entry %0 call: wrong number of arguments"},
      {"function @f.1(f32)\n  %0 = f32 arg 0\n  give 0 %0\nentry\n  %0 = i32 input n\n"
       "  %1 = call @f.1 %0\n",
       "entry %1 call: argument types differ"},
      {"function @f.1(f32)\n  %0 = f32 arg 0\n  give 0 %0\nentry\n  %0 = f32 input x\n"
       "  %1 = call @f.1 %0\n  %2 = f32 result 1 %1\n",
       "entry %2 result: index out of range"},
      {"entry\n  %0 = f32 input x\n  %1 = f32 result 0 %0\n",
       "entry %1 result: not of the last call"},
      {"entry\n  %0 = call @f.0\n", "entry %0 call: calls the entry"},
      {"entry\n  %0 = call @f.7\n", "entry %0 call: index out of range"},
  };
  for (const Case& c : cases) EXPECT_EQ(fault_of(c.text), c.fault) << c.text;
}

TEST(Verify, ATextureCallMayHaveALimit) {
  const auto fault_with = [](const std::string& operands) {
    return fault_of("entry\n  %0 = i32 input n\n  %1 = f32 input x\n  %2 = texture_call 0 " +
                    operands + "\n");
  };
  EXPECT_EQ(fault_with("%0 %1 %1 %1 %1 %1 %1"), "");
  EXPECT_EQ(fault_with("%0 %1 %1 %1 %1 %1 %1 %0"), "");
  EXPECT_EQ(fault_with("%0 %1 %1 %1 %1 %1 %1 %1"),
            "entry %2 texture_call: operand 7 is f32, not i32");
  for (const char* operands : {"%0 %1 %1 %1 %1 %1", "%0 %1 %1 %1 %1 %1 %1 %0 %0"}) {
    EXPECT_EQ(fault_with(operands), "entry %2 texture_call: wrong number of operands");
  }
}

TEST(Verify, EveryResultOfAFunctionIsGiven) {
  Program program;
  program.functions.push_back(
      {.name = "f", .arguments = {}, .results = {Scalar::f32}, .code = {}, .pool = {}});
  EXPECT_EQ(verify(program), "f: a result is not given");
}

}  // namespace
}  // namespace nacre
