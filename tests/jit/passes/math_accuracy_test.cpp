#include <gtest/gtest.h>

#include "tests/jit/passes/math_support.h"
#include "tests/support/random.h"

namespace nacre {
namespace {

struct Worst {
  double error = 0.0;
  std::size_t at = 0;

  void add(double candidate, std::size_t i) {
    if (!(candidate <= error)) *this = {candidate, i};
  }
};

/// precise and standard hold their bound for these arguments.
void expect_ulps(Op op, const Columns& inputs) {
  const std::vector<double> want = truth(op, inputs);
  for (const auto& [mode, bound] : {std::pair{Accuracy::precise, 1.0}, {Accuracy::standard, 4.0}}) {
    const std::vector<float> got = expanded(op, mode, inputs);
    Worst worst;
    for (std::size_t i = 0; i < got.size(); ++i) worst.add(ulps(got[i], want[i]), i);
    EXPECT_LE(worst.error, bound) << describe(op, mode) << " of "
                                  << testing::PrintToString(inputs.at("x")[worst.at]);
  }
}

/// Floats around the first `count` multiples of pi / 2 and some very large ones.
std::vector<float> near_quarter_turns(int count) {
  std::vector<float> list;
  const auto add = [&](double x) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(x));
    for (std::uint32_t d = 0; d < 5; ++d) list.push_back(std::bit_cast<float>(bits + d - 2));
  };
  for (int k = 1; k <= count; ++k) add(k * 1.5707963267948966);
  for (int k = 1; k <= count; ++k) add(k * 1.5707963267948966 * 4099.0);
  // 16367173 * 2^72 is the float nearest to a multiple of pi / 2 for its size
  // (J.-M. Muller, Elementary Functions, 3rd ed. 2016, table 11.1).
  list.push_back(std::ldexp(16367173.0f, 72));
  list.push_back(std::ldexp(-16367173.0f, 72));
  return list;
}

TEST(ExpandMath, AccuracyHoldsOverAllBinades) {
  const Columns inputs{{"x", floats(16411)}};
  for (const Op op : univariate) expect_ulps(op, inputs);
}

TEST(ExpandMath, AccuracyHoldsWhereResultsAreOrdinary) {
  for (const Op op : {Op::acos, Op::asin}) expect_ulps(op, {{"x", grid(-1.0f, 1.0f, 200001)}});
  for (const Op op : {Op::exp, Op::exp2}) expect_ulps(op, {{"x", grid(-130.0f, 130.0f, 200001)}});
  for (const Op op : {Op::log, Op::log2}) expect_ulps(op, {{"x", grid(0.5f, 2.5f, 200001)}});
  for (const Op op : {Op::sin, Op::cos, Op::tan}) {
    expect_ulps(op, {{"x", grid(-10.0f, 10.0f, 200001)}});
  }
}

TEST(ExpandMath, AccuracyHoldsNearZerosAndPoles) {
  const Columns inputs{{"x", near_quarter_turns(40000)}};
  for (const Op op : {Op::sin, Op::cos, Op::tan}) expect_ulps(op, inputs);
}

TEST(ExpandMath, PowIsAccurateToTheEndsOfTheRange) {
  Random random(7);
  Columns inputs;
  const auto unit = [&] { return static_cast<double>(random.word() >> 11) * 0x1p-53; };
  for (int i = 0; i < 400000; ++i) {
    const double reach = i % 2 == 0 ? 125.0 : std::exp2(-20.0 * unit());
    const auto x = static_cast<float>(std::exp2((2.0 * unit() - 1.0) * reach));
    inputs["x"].push_back(x);
    inputs["y"].push_back(
        static_cast<float>((2.0 * unit() - 1.0) * 135.0 / std::log2(static_cast<double>(x))));
  }
  expect_ulps(Op::pow, inputs);
}

TEST(ExpandMath, Atan2IsAccurateForEveryRatio) {
  Random random(8);
  Columns inputs;
  const auto unit = [&] { return static_cast<double>(random.word() >> 11) * 0x1p-53; };
  for (int i = 0; i < 400000; ++i) {
    const double size = std::exp2((2.0 * unit() - 1.0) * 100.0);
    const double ratio = std::exp2((2.0 * unit() - 1.0) * (i % 2 == 0 ? 2.0 : 26.0));
    inputs["x"].push_back(static_cast<float>(random.chance(0.5) ? size : -size));
    inputs["y"].push_back(static_cast<float>(random.chance(0.5) ? size * ratio : -size * ratio));
  }
  expect_ulps(Op::atan2, inputs);
}

/// The bounds that jit/passes/math/functions.h states for `fast`.
void expect_fast(Op op, const Columns& inputs, double absolute, double relative) {
  const std::vector<double> want = truth(op, inputs);
  const std::vector<float> got = expanded(op, Accuracy::fast, inputs);
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (!std::isfinite(static_cast<float>(want[i]))) {
      EXPECT_EQ(std::isnan(got[i]), std::isnan(want[i])) << info(op).name << " at " << i;
      continue;
    }
    const double error = std::fabs(static_cast<double>(got[i]) - want[i]);
    ASSERT_LE(error, absolute + relative * std::fabs(want[i]))
        << info(op).name << " of " << inputs.at("x")[i];
  }
}

TEST(ExpandMath, FastHoldsItsBounds) {
  constexpr double least_normal = 0x1p-126;
  const Columns all{{"x", floats(16411)}};
  expect_fast(Op::exp, all, least_normal, 0x1p-13);
  expect_fast(Op::exp2, all, least_normal, 0x1p-13);
  expect_fast(Op::log, all, 0.0, 0x1p-13);
  expect_fast(Op::log2, all, 0.0, 0x1p-13);
  expect_fast(Op::acos, all, 0x1p-14, 0.0);
  expect_fast(Op::asin, all, 0x1p-14, 0.0);
  const Columns angles{{"x", grid(-1e5f, 1e5f, 300001)}};
  expect_fast(Op::sin, angles, 0x1p-13, 0.0);
  expect_fast(Op::cos, angles, 0x1p-13, 0.0);
  expect_fast(Op::tan, {{"x", grid(-100.0f, 100.0f, 300001)}}, 0.0, 0x1p-13);
  Columns pairs;
  for (const float x : grid(0.0f, 4.0f, 601)) {
    for (const float y : grid(-60.0f, 60.0f, 601)) pairs["x"].push_back(x), pairs["y"].push_back(y);
  }
  expect_fast(Op::pow, pairs, least_normal, 0x1p-15);
  expect_fast(Op::atan2, pairs, 0.0, 0x1p-14);
}

TEST(ExpandMath, FastStaysBoundedForHugeAngles) {
  const Columns all{{"x", floats(16411)}};
  for (const Op op : {Op::sin, Op::cos}) {
    const std::vector<float> got = expanded(op, Accuracy::fast, all);
    for (std::size_t i = 0; i < got.size(); ++i) {
      if (std::isfinite(all.at("x")[i])) {
        ASSERT_LE(std::fabs(got[i]), 1.001f) << all.at("x")[i];
      } else {
        ASSERT_TRUE(std::isnan(got[i]));
      }
    }
  }
  const std::vector<float> tangents = expanded(Op::tan, Accuracy::fast, all);
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    ASSERT_EQ(std::isnan(tangents[i]), !std::isfinite(all.at("x")[i])) << all.at("x")[i];
  }
}

}  // namespace
}  // namespace nacre
