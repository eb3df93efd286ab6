#include "jit/passes/range.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numeric>

#include "runtime/interpreter/interpreter.h"
#include "runtime/value/vector.h"
#include "tests/support/random_program.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

// Programs of every operation, on inputs of any bits: nothing is ever outside of what is said.
TEST(Ranges, HoldWhatProgramsCompute) {
  constexpr std::uint64_t programs = 400;
  std::vector<std::uint32_t> order(64);
  std::iota(order.begin(), order.end(), 0u);
  std::size_t looked_at = 0, known = 0;
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const Program program = random_program(seed);
    const std::vector<Range> ranges = ranges_of(program);
    for (const ValueId value : top_level_values(program)) {
      if (program.entry().code[value].type != Scalar::f32) continue;
      const Range& range = ranges[value];
      ++looked_at;
      if (range == Range{}) continue;
      ++known;
      const Program part = program_of_value(program, value);
      const auto found =
          RandomBatch(part, seed, order).run(*make_interpreter(part), 0, order.size());
      for (const std::uint32_t bits : found.at(0)) {
        const double number = std::bit_cast<float>(bits);
        const bool is_in =
            std::isnan(number) ? range.nan : range.low <= number && number <= range.high;
        ASSERT_TRUE(is_in) << number << " of seed " << seed << ", value " << value << ": ["
                           << range.low << ", " << range.high << ']' << (range.nan ? ", NaN" : "");
      }
    }
  }
  EXPECT_GT(known, looked_at / 20);
}

Range range_of_output(const std::function<Float(Recorder&)>& body) {
  Recorder recorder;
  const std::vector<SliceOutput> outputs{{"y", body(recorder).ref()}};
  const Program program = slice(recorder.program(), "test", outputs);
  const Instruction& store = program.entry().code.back();
  return ranges_of(program)[store.operands[0]];
}

TEST(Ranges, KnowClampsWhateverComesIn) {
  const Range range =
      range_of_output([](Recorder& r) { return min(max(input(r, "x"), -2.0f), 3.0f); });
  EXPECT_EQ(range.low, -2);
  EXPECT_EQ(range.high, 3);
  EXPECT_TRUE(range.is_bounded());
  // Of NaN min and max give their second operand, which here is the one that may be NaN.
  EXPECT_TRUE(range_of_output([](Recorder& r) { return min(Float(3.0f), input(r, "x")); }).nan);
}

TEST(Ranges, OfQuotientsBySomethingThatMayBeZeroAreUnknown) {
  const auto quotient = [](float low) {
    return range_of_output([low](Recorder& r) {
      const Float x = min(max(input(r, "x"), low), 4.0f);
      return 2.0f / x;
    });
  };
  EXPECT_EQ(quotient(0.0f), Range{});
  EXPECT_EQ(quotient(-1.0f), Range{});
  EXPECT_NEAR(quotient(0.5f).low, 0.5, 1e-5);
  EXPECT_NEAR(quotient(0.5f).high, 4, 1e-5);
}

/// Of an integer that points with such x and y have.
Range range_of_index(const Range& x, const Range& y) {
  Recorder recorder;
  const Float u = input(recorder, "x");
  const Float v = input(recorder, "y");
  // The cell of a tile in a directory of seven columns that begins at column 2 of row 3.
  const Int index = to_int(floor(v) - 3.0f) * Int(7) + to_int(floor(u) - 2.0f);
  const std::vector<SliceOutput> outputs{{"i", index.ref()}};
  const Program program = slice(recorder.program(), "test", outputs);
  std::vector<Range> inputs;
  for (const Channel& channel : program.inputs) inputs.push_back(channel.name == "x" ? x : y);
  return ranges_of(program, inputs)[program.entry().code.back().operands[0]];
}

TEST(Ranges, OfKnownInputsNameTheCellOfATile) {
  const auto within = [](double low, double high) { return Range{low, high, false}; };
  EXPECT_EQ(range_of_index(within(4.01, 4.99), within(5.01, 5.99)), within(2 * 7 + 2, 2 * 7 + 2));
  EXPECT_EQ(range_of_index(within(8, 8.5), within(3, 3.5)), within(6, 6));
  const Range several = range_of_index(within(4.5, 5.5), within(5.01, 5.99));
  EXPECT_LE(several.low, 16);
  EXPECT_GE(several.high, 17);
  EXPECT_GT(several.low, 14);
  EXPECT_LT(several.high, 19);
  EXPECT_FALSE(range_of_index({}, within(5.01, 5.99)).is_bounded());
  EXPECT_FALSE(range_of_index(within(4, 1e12), within(5.01, 5.99)).is_bounded());
  EXPECT_FALSE(range_of_index({4, 5, true}, within(5.01, 5.99)).is_bounded());
}

}  // namespace
}  // namespace nacre
