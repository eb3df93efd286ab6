// What ranges make certain: it is left out, and no bit of a result changes.

#include "jit/passes/decide.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "runtime/interpreter/interpreter.h"
#include "runtime/value/control.h"
#include "runtime/value/vector.h"
#include "tests/jit/passes/within.h"
#include "tests/support/random.h"
#include "tests/support/random_program.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

constexpr std::size_t no_limit = 1'000'000;

// Programs of every operation, on numbers within what is known of them: the same bits, with less.
TEST(Decide, KeepsTheBitsOfWhatProgramsCompute) {
  constexpr std::uint64_t programs = 600;
  std::size_t shorter = 0, all = 0;
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const Program program = random_program(seed, {.memory = false});
    Random random(seed + 1000);
    for (const ValueId value : top_level_values(program)) {
      const Program part = program_of_value(program, value);
      const Within within(part, random);
      const Known known{.inputs = within.ranges,
                        .parameters = {},
                        .dots = {},
                        .arithmetic = Arithmetic::as_written};
      const Program decided = decide(part, known, no_limit);
      ++all;
      shorter += instruction_count(decided) < instruction_count(part) ? 1u : 0u;
      ASSERT_EQ(within.run(decided), within.run(part))
          << "seed " << seed << ", value " << value << '\n'
          << to_string(part) << to_string(decided);
    }
  }
  EXPECT_GT(shorter, all / 20) << all;
}

// The same of any bits, of which nothing is known.
TEST(Decide, KeepsTheBitsOfWhateverComesIn) {
  constexpr std::uint64_t programs = 300;
  std::vector<std::uint32_t> order(64);
  std::iota(order.begin(), order.end(), 0u);
  std::size_t shorter = 0;
  for (std::uint64_t seed = 0; seed < programs; ++seed) {
    const Program program = random_program(seed);
    const Known known{
        .inputs = {}, .parameters = {}, .dots = {}, .arithmetic = Arithmetic::as_written};
    const Program decided = decide(program, known, no_limit);
    shorter += instruction_count(decided) < instruction_count(program) ? 1u : 0u;
    const RandomBatch batch(program, seed, order);
    const auto found = batch.run(*make_interpreter(decided), 0, order.size());
    const auto expected = batch.run(*make_interpreter(program), 0, order.size());
    ASSERT_EQ(found, expected) << "seed " << seed << '\n'
                               << to_string(program) << to_string(decided);
  }
  EXPECT_GT(shorter, programs / 20);
}

using Body = std::function<Float(Recorder& recorder, Float x, Float y)>;

Program program_of(const Body& body) {
  Recorder recorder;
  const Float x = input(recorder, "x"), y = input(recorder, "y");
  return slice(
      recorder.program(), "test",
      std::vector<SliceOutput>{{"z", body(recorder, x, y).ref()}, {"x", x.ref()}, {"y", y.ref()}});
}

/// The text of what is left, where x and y are so.
std::string decided(const Body& body, const Range& x, const Range& y) {
  const Program program = program_of(body);
  const Known known{.inputs = {x, y}, .parameters = {}, .dots = {}};
  return to_string(decide(program, known, no_limit));
}

bool has(const std::string& text, const std::string& operation) {
  return text.find(' ' + operation + ' ') != std::string::npos;
}

TEST(Decide, ComparisonsThatAreCertainChoose) {
  const Body body = [](Recorder&, Float x, Float y) { return select(x < y, x + y, x * y); };
  const std::string less = decided(body, {0, 1, false}, {2, 3, false});
  EXPECT_FALSE(has(less, "select") || has(less, "mul") || has(less, "lt")) << less;
  EXPECT_TRUE(has(less, "add")) << less;
  const std::string more = decided(body, {2, 3, false}, {0, 1, false});
  EXPECT_TRUE(has(more, "mul") && !has(more, "add")) << more;
  EXPECT_TRUE(has(decided(body, {0, 1, false}, {0.5, 3, false}), "select"));
}

TEST(Decide, NaNIsLessThanNothing) {
  const Body body = [](Recorder&, Float x, Float y) { return select(x < y, x + y, x * y); };
  // True of numbers, and a NaN makes it false.
  EXPECT_TRUE(has(decided(body, {0, 1, true}, {2, 3, false}), "select"));
  // False of numbers and of NaN.
  EXPECT_FALSE(has(decided(body, {2, 3, true}, {0, 1, true}), "select"));
  const Body is_nan = [](Recorder&, Float x, Float) { return select(x != x, Float(7.0f), x); };
  EXPECT_TRUE(has(decided(is_nan, {0, 1, true}, {}), "select"));
  EXPECT_FALSE(has(decided(is_nan, {0, 1, false}, {}), "select"));
}

TEST(Decide, ClampsThatChangeNothingGo) {
  const Body clamp = [](Recorder&, Float x, Float) { return min(max(x, 0.0f), 1.0f); };
  const std::string within = decided(clamp, {0.25, 0.5, false}, {});
  EXPECT_FALSE(has(within, "min") || has(within, "max")) << within;
  const std::string below = decided(clamp, {-1, 0.5, false}, {});
  EXPECT_TRUE(has(below, "max") && !has(below, "min")) << below;
  // max(NaN, 0) is 0.
  EXPECT_TRUE(has(decided(clamp, {0.25, 0.5, true}, {}), "max"));
}

// max(-0, 0) is 0, by op.h's a > b ? a : b.
TEST(Decide, ZeroKeepsItsSign) {
  const Body body = [](Recorder&, Float x, Float) { return max(x, 0.0f); };
  EXPECT_TRUE(has(decided(body, {0, 1, false}, {}), "max"));
  const Body square = [](Recorder&, Float x, Float) { return max(x * x, 0.0f); };
  EXPECT_FALSE(has(decided(square, {-1, 1, false}, {}), "max"));
  const Body sum = [](Recorder&, Float x, Float y) { return x + y; };
  const std::string exact = decided(sum, {-1, 1, false}, {0, 0, false, false});
  EXPECT_TRUE(has(exact, "add")) << exact;  // -0 + 0 is 0.
  // What is too small to be a float is a zero of its sign.
  const Body product = [](Recorder&, Float x, Float y) { return max(abs(x) * y, 0.0f); };
  EXPECT_TRUE(has(decided(product, {-1, 1, false}, {0, 1, false}), "max"));
  EXPECT_FALSE(has(decided(product, {-1, 1, false}, {0.5, 1, false}), "max"));
}

// What is below 1 stays below it by rounding to nearest, but not where sums are made of other
// parts.
TEST(Decide, RoundingGoesNoFurtherThanItMust) {
  const auto is_clamped = [](Arithmetic arithmetic, const Body& body) {
    const Program program = program_of(body);
    const Range unit{0, 1, false, false};
    const Known known{
        .inputs = {unit, unit}, .parameters = {}, .dots = {}, .arithmetic = arithmetic};
    const std::string text = to_string(decide(program, known, no_limit));
    return has(text, "min") || has(text, "max");
  };
  const Body product = [](Recorder&, Float x, Float y) { return min(x * y, 1.0f); };
  EXPECT_FALSE(is_clamped(Arithmetic::as_written, product));
  EXPECT_TRUE(is_clamped(Arithmetic::unknown, product));
  const Body rest = [](Recorder&, Float x, Float y) { return sqrt(max(1.0f - x * y, 0.0f)); };
  EXPECT_FALSE(is_clamped(Arithmetic::as_written, rest));
  EXPECT_TRUE(is_clamped(Arithmetic::reassociated, rest));
}

TEST(Decide, RegionsThatNoLaneEntersGo) {
  const Body body = [](Recorder&, Float x, Float y) {
    return if_any(x > 1.0f, y, [&] { return sqrt(x) / y + sqrt(y); });
  };
  const std::string never = decided(body, {0, 1, false}, {});
  EXPECT_EQ(never.find("if_any"), std::string::npos) << never;
  EXPECT_FALSE(has(never, "sqrt")) << never;
  const std::string always = decided(body, {2, 3, false}, {});
  EXPECT_EQ(always.find("if_any"), std::string::npos) << always;
  EXPECT_TRUE(has(always, "sqrt")) << always;
  EXPECT_NE(decided(body, {0, 3, false}, {}).find("if_any"), std::string::npos);
}

TEST(Decide, NumbersThatAreKnownAreLiterals) {
  const Body body = [](Recorder&, Float x, Float y) { return x * sqrt(y); };
  const std::string text = decided(body, {2, 2, false}, {9, 9, false});
  EXPECT_FALSE(has(text, "sqrt") || has(text, "mul")) << text;
  EXPECT_TRUE(has(text, "const")) << text;
  // 0 of either sign is two numbers, and what is infinite times 0 is NaN.
  const Body weighed = [](Recorder&, Float x, Float y) { return fma(x, y, 1.0f); };
  EXPECT_FALSE(has(decided(weighed, {0, 0, false}, {-5, 5, false}), "fma"));
  EXPECT_TRUE(has(decided(weighed, {0, 0, false}, {}), "fma"));
  const Body product = [](Recorder&, Float x, Float y) { return x * y; };
  EXPECT_TRUE(has(decided(product, {0, 0, false, false}, {-5, 5, false}), "mul"));
  EXPECT_FALSE(has(decided(product, {0, 0, false, false}, {1, 5, false}), "mul"));
}

TEST(Decide, OfMultiplesOfOneNumberTheOrderIsThatOfTheFactors) {
  const Body most = [](Recorder&, Float x, Float y) { return max(max(0.2f * x, x * 0.8f), x * y); };
  const std::string known = decided(most, {0, 1, false, false}, {0.3, 0.5, false});
  EXPECT_FALSE(has(known, "max") || has(known, "fma")) << known;
  EXPECT_TRUE(has(known, "mul")) << known;
  // Below 0 it is the other way round, and a number that may be NaN is not known.
  EXPECT_TRUE(has(decided(most, {-1, 1, false}, {0.3, 0.5, false}), "max"));
  EXPECT_TRUE(has(decided(most, {0, 1, true, false}, {0.3, 0.5, false}), "max"));
  EXPECT_TRUE(has(decided(most, {0, 1, false, false}, {0.3, 0.9, false}), "max"));
  const Body least = [](Recorder&, Float x, Float) { return min(0.2f * x, x * 0.8f); };
  EXPECT_FALSE(has(decided(least, {0, 1, false, false}, {}), "min"));
}

TEST(Decide, TablesOfOneNumberAreLiterals) {
  const auto text = [](std::vector<float> values) {
    const Body body = [&](Recorder& recorder, Float x, Float) {
      const Ref index = recorder.emit(Op::f_to_i, std::array{x.ref()});
      return Float(recorder.emit(Op::table, std::array{index}, recorder.table("some", values)));
    };
    return decided(body, {0, 2, false}, {});
  };
  EXPECT_EQ(text({0.4f, 0.4f, 0.4f}).find("table"), std::string::npos);
  EXPECT_NE(text({0.4f, 0.4f, 0.5f}).find("table"), std::string::npos);
}

TEST(Decide, WhatIsLeftOutMakesMoreCertain) {
  // Of both ways of the first choice the second is not certain.
  const Body body = [](Recorder&, Float x, Float y) {
    const Float chosen = select(x < 0.0f, y * y, x);
    return select(chosen < 5.0f, chosen, y);
  };
  EXPECT_FALSE(has(decided(body, {0, 1, false}, {}), "select"));
}

/// The number of lt in what is left of a comparison of dot(N, wo) with 0.
std::size_t comparisons(const std::vector<DotRange>& dots, const Range& component) {
  Recorder recorder;
  const auto vector = [&](const std::string& name) {
    return Float3(input(recorder, name + ".x"), input(recorder, name + ".y"),
                  input(recorder, name + ".z"));
  };
  const Float cosine = dot(vector("N"), vector("wo"));
  const Program program =
      slice(recorder.program(), "test",
            std::vector<SliceOutput>{{"z", select(cosine < 0.0f, -cosine, cosine).ref()}});
  const Known known{.inputs = std::vector<Range>(6, component), .parameters = {}, .dots = dots};
  const std::string text = to_string(decide(program, known, no_limit));
  return has(text, "lt") ? 1u : 0u;
}

TEST(Decide, ScalarProductsAreKnownHoweverTheyAreSummed) {
  constexpr Range unit{-1, 1, false}, above{0.01, 1, false};
  EXPECT_EQ(comparisons({{"N", "wo", above}}, unit), 0u);
  EXPECT_EQ(comparisons({{"wo", "N", above}}, unit), 0u);
  EXPECT_EQ(comparisons({}, unit), 1u);
  EXPECT_EQ(comparisons({{"N", "wi", above}}, unit), 1u);
  // Of long vectors roundings may be more than that.
  EXPECT_EQ(comparisons({{"N", "wo", above}}, {-1000, 1000, false}), 1u);
  EXPECT_EQ(comparisons({{"N", "wo", above}}, {}), 1u);
}

}  // namespace
}  // namespace nacre
