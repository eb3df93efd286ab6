#include "jit/passes/range.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <numeric>

#include "runtime/interpreter/interpreter.h"
#include "runtime/value/control.h"
#include "runtime/value/vector.h"
#include "tests/jit/passes/within.h"
#include "tests/support/random.h"
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

// The same where inputs are known, with all that is done then: functions, rounds of loops, parts.
TEST(Ranges, HoldWhatProgramsComputeOfKnownInputs) {
  constexpr std::uint64_t programs = 600;
  std::size_t looked_at = 0, known = 0;
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const Program program = random_program(seed, {.memory = false});
    Random random(seed);
    for (const ValueId value : top_level_values(program)) {
      const Scalar type = program.entry().code[value].type;
      if (type != Scalar::f32 && type != Scalar::i32) continue;
      const Program part = program_of_value(program, value);
      const Within within(part, random);
      const Range range = output_ranges(part, within.ranges)[0];
      ++looked_at;
      if (range == Range{}) continue;
      ++known;
      for (const std::uint32_t bits : within.run(part)) {
        const double number = type == Scalar::f32 ? double(std::bit_cast<float>(bits))
                                                  : double(std::bit_cast<std::int32_t>(bits));
        const bool is_in =
            std::isnan(number) ? range.nan : range.low <= number && number <= range.high;
        ASSERT_TRUE(is_in) << number << " of seed " << seed << ", value " << value << ": ["
                           << range.low << ", " << range.high << ']' << (range.nan ? ", NaN" : "");
      }
    }
  }
  EXPECT_GT(known, looked_at / 5) << looked_at;
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

/// Of what `body` makes of an x in [low, high].
template <class Body>
Range range_of(Body&& body, double low, double high) {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const std::vector<SliceOutput> outputs{{"y", Float(body(recorder, x)).ref()}};
  const Range inputs[]{{low, high, false}};
  return output_ranges(slice(recorder.program(), "test", outputs), inputs)[0];
}

// x - x^2 is in [0, 1/4] for x in [0, 1]; 6 x^5 - 15 x^4 + 10 x^3 rises from 0 to 1.
TEST(Ranges, OfOneNumberThatIsMetTwiceAreNearlyTight) {
  const Range parabola = range_of([](Recorder&, Float x) { return x - x * x; }, 0, 1);
  EXPECT_NEAR(parabola.low, 0, 2e-3);
  EXPECT_NEAR(parabola.high, 0.25, 2e-3);
  const Range fade = range_of(
      [](Recorder&, Float t) { return t * t * t * fma(t, fma(t, 6.0f, -15.0f), 10.0f); }, 0, 1);
  EXPECT_NEAR(fade.low, 0, 0.02);
  EXPECT_NEAR(fade.high, 1, 0.02);
}

TEST(Ranges, OfWhatLiesBetweenTwoNumbersAreNoWider) {
  const Range between =
      range_of([](Recorder&, Float x) { return lerp(Float(3.0f), floor(x), fract(x)); }, -1.5, 2.5);
  EXPECT_NEAR(between.low, -2, 1e-3);
  EXPECT_NEAR(between.high, 3, 1e-3);
}

TEST(Ranges, GoThroughFunctions) {
  const auto body = [](Recorder& recorder, Float x) {
    const auto twice = [](Float y) { return y * 2.0f; };
    return outline<Float>(recorder, "twice", twice, x) +
           outline<Float>(recorder, "twice", twice, 1.0f - x);
  };
  const Range range = range_of(body, 0, 0.5);
  EXPECT_NEAR(range.low, 1, 1e-4);
  EXPECT_NEAR(range.high, 3, 1e-4);
}

// Of the rounds of a loop each is known: 1 + 2 + 3 + 4 = 10, if it does not end before.
TEST(Ranges, FollowTheRoundsOfLoops) {
  const auto body = [](Recorder& recorder, Float x) {
    const auto round = [&](Int i, Float& sum) {
      sum = sum + to_float(i + Int(1));
      return to_float(i) < x;
    };
    return loop(recorder, Bool(true), 4, Float(0.0f), round);
  };
  const Range range = range_of(body, -10, 10);
  EXPECT_NEAR(range.low, 1, 1e-4);
  EXPECT_NEAR(range.high, 10, 1e-4);
  const auto perhaps = [&](Recorder& recorder, Float x) {
    const auto round = [&](Int, Float& sum) {
      sum = sum + Float(1.0f);
      return Bool(true);
    };
    return loop(recorder, x > 0.0f, 3, Float(5.0f), round);
  };
  EXPECT_NEAR(range_of(perhaps, -1, 1).low, 5, 1e-4);
  EXPECT_NEAR(range_of(perhaps, -1, 1).high, 8, 1e-4);
}

// What is looked at more than once has an end: a long chain, loops in loops in loops.
TEST(Ranges, TakeNoLongerThanProgramsAreLong) {
  const auto chain = [](Recorder&, Float x) {
    Float y = x;
    for (int i = 0; i < 100'000; ++i) y = fma(y, 0.999f, 1e-3f);
    return x * y;
  };
  EXPECT_TRUE(range_of(chain, 0, 1).is_bounded());
  const auto nested = [](Recorder& recorder, Float x) {
    std::function<Float(int, Float)> loops = [&](int depth, Float start) -> Float {
      if (depth == 0) return start + x;
      return loop(recorder, Bool(true), 64, start, [&](Int, Float& sum) {
        sum = loops(depth - 1, sum);
        return sum < 1e6f;
      });
    };
    return loops(8, 0.0f);
  };
  EXPECT_FALSE(range_of(nested, 0, 1).is_bounded());
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
