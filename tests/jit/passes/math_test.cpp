#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/value/control.h"
#include "tests/jit/passes/math_support.h"

namespace nacre {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float largest = std::numeric_limits<float>::max();
constexpr float pi = 3.14159274f;

struct Special {
  Op op;
  float x, y;
  float want;
};

// ISO/IEC 9899:2018, annex F.10.1, F.10.3 and F.10.4. Operand order is the
// operation's: atan2 takes (y, x). Signs of zero are checked.
const std::vector<Special>& exact_cases() {
  static const std::vector<Special> cases{
      {Op::acos, 1.0f, 0, 0.0f},
      {Op::acos, 1.0000001f, 0, nan},
      {Op::acos, -inf, 0, nan},
      {Op::asin, 0.0f, 0, 0.0f},
      {Op::asin, -0.0f, 0, -0.0f},
      {Op::asin, -1.5f, 0, nan},
      {Op::asin, inf, 0, nan},
      {Op::cos, 0.0f, 0, 1.0f},
      {Op::cos, -0.0f, 0, 1.0f},
      {Op::cos, inf, 0, nan},
      {Op::sin, 0.0f, 0, 0.0f},
      {Op::sin, -0.0f, 0, -0.0f},
      {Op::sin, -inf, 0, nan},
      {Op::tan, 0.0f, 0, 0.0f},
      {Op::tan, -0.0f, 0, -0.0f},
      {Op::tan, inf, 0, nan},
      {Op::exp, 0.0f, 0, 1.0f},
      {Op::exp, -0.0f, 0, 1.0f},
      {Op::exp, -inf, 0, 0.0f},
      {Op::exp, inf, 0, inf},
      {Op::exp, 89.0f, 0, inf},
      {Op::exp, -104.0f, 0, 0.0f},
      {Op::exp, -largest, 0, 0.0f},
      {Op::exp, 1e-38f, 0, 1.0f},
      {Op::exp2, 0.0f, 0, 1.0f},
      {Op::exp2, 127.0f, 0, 0x1p+127f},
      {Op::exp2, -126.0f, 0, 0x1p-126f},
      {Op::exp2, 128.0f, 0, inf},
      {Op::exp2, -150.0f, 0, 0.0f},
      {Op::exp2, inf, 0, inf},
      {Op::exp2, -inf, 0, 0.0f},
      {Op::log, 1.0f, 0, 0.0f},
      {Op::log, 0.0f, 0, -inf},
      {Op::log, -0.0f, 0, -inf},
      {Op::log, 1e-40f, 0, -inf},  // A denormal is zero.
      {Op::log, -1e-30f, 0, nan},
      {Op::log, -inf, 0, nan},
      {Op::log, inf, 0, inf},
      {Op::log2, 1.0f, 0, 0.0f},
      {Op::log2, 0x1p-126f, 0, -126.0f},
      {Op::log2, 0x1p+127f, 0, 127.0f},
      {Op::log2, 0.0f, 0, -inf},
      {Op::log2, -1.0f, 0, nan},
      {Op::log2, inf, 0, inf},
      {Op::atan2, 0.0f, 1.0f, 0.0f},
      {Op::atan2, -0.0f, 1.0f, -0.0f},
      {Op::atan2, 0.0f, 0.0f, 0.0f},
      {Op::atan2, -0.0f, 0.0f, -0.0f},
      {Op::atan2, 0.0f, -0.0f, pi},
      {Op::atan2, -0.0f, -0.0f, -pi},
      {Op::atan2, -0.0f, -1.0f, -pi},
      {Op::atan2, 1.0f, 0.0f, pi / 2},
      {Op::atan2, -1.0f, -0.0f, -pi / 2},
      {Op::atan2, 2.0f, -inf, pi},
      {Op::atan2, -2.0f, inf, -0.0f},
      {Op::atan2, inf, 3.0f, pi / 2},
      {Op::atan2, -inf, -largest, -pi / 2},
      {Op::atan2, nan, 1.0f, nan},
      {Op::atan2, 1.0f, nan, nan},
      {Op::atan2, nan, inf, nan},
      {Op::atan2, inf, nan, nan},
      {Op::pow, 0.0f, -3.0f, inf},
      {Op::pow, -0.0f, -3.0f, -inf},
      {Op::pow, -0.0f, -2.0f, inf},
      {Op::pow, -0.0f, -0.5f, inf},
      {Op::pow, -0.0f, -inf, inf},
      {Op::pow, 0.0f, 3.0f, 0.0f},
      {Op::pow, -0.0f, 3.0f, -0.0f},
      {Op::pow, -0.0f, 2.5f, 0.0f},
      {Op::pow, -1.0f, inf, 1.0f},
      {Op::pow, -1.0f, -inf, 1.0f},
      {Op::pow, -1.0f, 3.0f, -1.0f},
      {Op::pow, -1.0f, 8388609.0f, -1.0f},
      {Op::pow, -1.0f, 16777218.0f, 1.0f},
      {Op::pow, -1.0f, nan, nan},
      {Op::pow, 1.0f, nan, 1.0f},
      {Op::pow, 1.0f, inf, 1.0f},
      {Op::pow, nan, 0.0f, 1.0f},
      {Op::pow, 0.0f, 0.0f, 1.0f},
      {Op::pow, inf, -0.0f, 1.0f},
      {Op::pow, nan, 2.0f, nan},
      {Op::pow, 2.0f, nan, nan},
      {Op::pow, -2.0f, 0.5f, nan},
      {Op::pow, -largest, 0.25f, nan},
      {Op::pow, 0.5f, -inf, inf},
      {Op::pow, 1.5f, -inf, 0.0f},
      {Op::pow, -0.5f, inf, 0.0f},
      {Op::pow, 1.0000001f, inf, inf},
      {Op::pow, 0.99999994f, inf, 0.0f},
      {Op::pow, -inf, -3.0f, -0.0f},
      {Op::pow, -inf, -2.5f, 0.0f},
      {Op::pow, -inf, 3.0f, -inf},
      {Op::pow, -inf, 0.5f, inf},
      {Op::pow, inf, -1e-30f, 0.0f},
      {Op::pow, inf, 1e-30f, inf},
      {Op::pow, 2.0f, 10.0f, 1024.0f},
      {Op::pow, -2.0f, 9.0f, -512.0f},
      {Op::pow, largest, 2.0f, inf},
      {Op::pow, 1e-30f, 3.0f, 0.0f},
      {Op::pow, 2.0f, largest, inf},
      {Op::pow, 2.0f, -largest, 0.0f},
  };
  return cases;
}

bool same_special(float got, float want, Accuracy mode) {
  if (std::isnan(want)) return std::isnan(got);
  if (want == 0.0f && mode == Accuracy::fast) return got == 0.0f;
  if (want == 0.0f || std::isinf(want))
    return got == want && std::signbit(got) == std::signbit(want);
  // Finite values stand here for what they are near.
  return std::fabs(got - want) <= (mode == Accuracy::fast ? 0x1p-13f : 0x1p-22f) * std::fabs(want);
}

TEST(ExpandMath, SpecialValuesAreAnnexFs) {
  for (const Accuracy mode : modes) {
    for (const Special& each : exact_cases()) {
      const float got = expanded(each.op, mode, {{"x", {each.x}}, {"y", {each.y}}}).front();
      EXPECT_TRUE(same_special(got, each.want, mode))
          << describe(each.op, mode) << " of " << each.x << ", " << each.y << ": " << got
          << " instead of " << each.want;
    }
  }
}

TEST(ExpandMath, NanGivesNan) {
  for (const Accuracy mode : modes) {
    for (const Op op : univariate) {
      const float bits = std::bit_cast<float>(0xffc12345u);
      EXPECT_TRUE(std::isnan(expanded(op, mode, {{"x", {bits}}}).front())) << describe(op, mode);
    }
  }
}

TEST(ExpandMath, ExactPointsOfFast) {
  const auto fast = [](Op op, float x, float y = 0.0f) {
    return expanded(op, Accuracy::fast, {{"x", {x}}, {"y", {y}}}).front();
  };
  EXPECT_EQ(fast(Op::exp, 0.0f), 1.0f);
  EXPECT_EQ(fast(Op::log, 1.0f), 0.0f);
  EXPECT_EQ(fast(Op::cos, 0.0f), 1.0f);
  EXPECT_EQ(fast(Op::sin, 0.0f), 0.0f);
  EXPECT_EQ(fast(Op::asin, 0.0f), 0.0f);
  EXPECT_EQ(fast(Op::acos, 1.0f), 0.0f);
  EXPECT_LE(fast(Op::sin, pi / 2), 1.0f);
  for (const float x : {0.1f, 0.5f, 3.0f, 1e10f}) {
    EXPECT_EQ(fast(Op::pow, x, 0.0f), 1.0f);
    EXPECT_NEAR(fast(Op::pow, x, 1.0f) / x, 1.0f, 1e-5f);
  }
  for (int n = -126; n <= 127; ++n) {
    EXPECT_EQ(fast(Op::exp2, static_cast<float>(n)), std::ldexp(1.0f, n));
    EXPECT_EQ(fast(Op::log2, std::ldexp(1.0f, n)), static_cast<float>(n));
  }
}

TEST(ExpandMath, PowersOfTwoAreExact) {
  for (const Accuracy mode : modes) {
    Columns exponents;
    Columns powers;
    for (int n = -126; n <= 127; ++n) {
      exponents["x"].push_back(static_cast<float>(n));
      powers["x"].push_back(std::ldexp(1.0f, n));
    }
    EXPECT_EQ(expanded(Op::exp2, mode, exponents), powers.at("x"));
    EXPECT_EQ(expanded(Op::log2, mode, powers), exponents.at("x"));
  }
}

TEST(ExpandMath, SineAndCosineStandOnTheUnitCircle) {
  const Columns angles{{"x", grid(-1e5f, 1e5f, 100001)}};
  for (const auto& [mode, bound] :
       {std::pair{Accuracy::precise, 2e-7}, {Accuracy::standard, 4e-7}, {Accuracy::fast, 3e-4}}) {
    const std::vector<float> s = expanded(Op::sin, mode, angles);
    const std::vector<float> c = expanded(Op::cos, mode, angles);
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double a = static_cast<double>(s[i]);
      const double b = static_cast<double>(c[i]);
      ASSERT_NEAR(a * a + b * b, 1.0, bound) << angles.at("x")[i];
    }
  }
}

TEST(ExpandMath, InverseFunctionsReturn) {
  const std::vector<float> x = grid(-1.5f, 1.5f, 20001);
  for (const auto& [mode, bound] : {std::pair{Accuracy::precise, 4e-7f},
                                    {Accuracy::standard, 1e-6f},
                                    {Accuracy::fast, 6e-4f}}) {
    const std::vector<float> s = expanded(Op::sin, mode, {{"x", x}});
    const std::vector<float> c = expanded(Op::cos, mode, {{"x", x}});
    const std::vector<float> angle = expanded(Op::atan2, mode, {{"x", s}, {"y", c}});
    const std::vector<float> power = expanded(Op::exp, mode, {{"x", x}});
    const std::vector<float> logarithm = expanded(Op::log, mode, {{"x", power}});
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_NEAR(angle[i], x[i], bound) << accuracy_name(mode);
      ASSERT_NEAR(logarithm[i], x[i], bound) << accuracy_name(mode);
    }
  }
}

TEST(ExpandMath, ArcSineAndArcCosineAddUpToAQuarter) {
  const Columns inputs{{"x", grid(-1.0f, 1.0f, 20001)}};
  for (const auto& [mode, bound] : {std::pair{Accuracy::precise, 4e-7f},
                                    {Accuracy::standard, 8e-7f},
                                    {Accuracy::fast, 2e-4f}}) {
    const std::vector<float> s = expanded(Op::asin, mode, inputs);
    const std::vector<float> c = expanded(Op::acos, mode, inputs);
    for (std::size_t i = 0; i < s.size(); ++i) ASSERT_NEAR(s[i] + c[i], pi / 2, bound);
  }
}

TEST(ExpandMath, PowOfHalfIsTheSquareRoot) {
  Columns inputs;
  for (float x = 1e-37f; x < 1e37f; x *= 1.01f) inputs["x"].push_back(x);
  inputs["y"] = {0.5f};
  const std::vector<float> got = expanded(Op::pow, Accuracy::precise, inputs);
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_LE(ulps(got[i], std::sqrt(static_cast<double>(inputs.at("x")[i]))), 1.0);
  }
}

TEST(ExpandMath, ExponentialNeverDecreases) {
  const std::vector<float> x = grid(-87.0f, 88.0f, 400001);
  for (const Accuracy mode : modes) {
    for (const Op op : {Op::exp, Op::exp2}) {
      const std::vector<float> got = expanded(op, mode, {{"x", x}});
      EXPECT_TRUE(std::is_sorted(got.begin(), got.end())) << describe(op, mode);
    }
  }
}

/// sin and cos of x, or one of them.
Program circle(bool sine, bool cosine) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  std::vector<SliceOutput> outputs;
  if (sine) outputs.push_back({"sin", sin(x).ref()});
  if (cosine) outputs.push_back({"cos", cos(x).ref()});
  return slice(recorder.program(), "circle", outputs);
}

std::size_t count(const Program& program, Op op) {
  std::size_t found = 0;
  for (const Instruction& instruction : program.entry().code) found += instruction.op == op;
  return found;
}

TEST(ExpandMath, SineAndCosineShareTheReduction) {
  for (const Accuracy mode : modes) {
    const auto size = [&](bool sine, bool cosine) {
      return expand_math(circle(sine, cosine), mode).entry().code.size();
    };
    EXPECT_LT(size(true, true) + 8, size(true, false) + size(false, true));
    const std::size_t regions = mode == Accuracy::fast ? 0 : 1;
    EXPECT_EQ(count(expand_math(circle(true, true), mode), Op::if_any), regions);
  }
}

// The same bits, without what only large ones need.
TEST(ExpandMath, AnglesThatAreKnownToBeSmallHaveNoOtherPath) {
  const auto of = [](bool is_known) {
    Recorder recorder;
    const Float x(recorder.input("x", Scalar::f32));
    const Float angle = (is_known ? min(max(x, -1.0f), 1.0f) : x) * 6.2831855f;
    const std::vector<SliceOutput> outputs{{"sin", sin(angle).ref()}, {"cos", cos(angle).ref()}};
    return slice(recorder.program(), "turn", outputs);
  };
  std::vector<float> x;
  for (int i = -10'000; i <= 10'000; ++i) x.push_back(static_cast<float>(i) / 10'000.0f);
  for (const Accuracy mode : {Accuracy::standard, Accuracy::precise}) {
    const Program any = expand_math(of(false), mode), small = expand_math(of(true), mode);
    EXPECT_EQ(count(any, Op::if_any), 1u);
    EXPECT_EQ(count(small, Op::if_any), 0u);
    EXPECT_LT(small.functions.size(), any.functions.size());
    const auto expected = run(*make_interpreter(any), {{"x", x}});
    const auto found = run(*make_interpreter(small), {{"x", x}});
    EXPECT_EQ(found.at("sin"), expected.at("sin"));
    EXPECT_EQ(found.at("cos"), expected.at("cos"));
  }
}

TEST(ExpandMath, NeighboursChangeNothing) {
  const Columns inputs{{"x", floats(1000003)}};
  for (const Accuracy mode : modes) {
    const auto both = run(*make_interpreter(expand_math(circle(true, true), mode)), inputs);
    const auto alone = run(*make_interpreter(expand_math(circle(false, true), mode)), inputs);
    for (std::size_t i = 0; i < inputs.at("x").size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(both.at("cos")[i]),
                std::bit_cast<std::uint32_t>(alone.at("cos")[i]));
    }
  }
}

/// Functions in regions, in outlined functions and in loops, of one argument.
Program nested() {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const Float y(recorder.input("y", Scalar::f32));
  const Float first = if_any(x > 0.0f, Float(0.0f), [&] { return sin(x) + pow(x, y); });
  const Float second = if_any(x < 1.0f, Float(0.0f), [&] { return sin(x) * cos(x); });
  const auto body = [](Float a, Float b) { return tan(a) + pow(abs(a), b); };
  const Float third = outline<Float>(recorder, "body", body, x, y);
  const Float fourth = outline<Float>(recorder, "body", body, y, first);
  const Float fifth = loop(recorder, y > 0.0f, 3, x, [](Int, Float& z) {
    z = cos(z);
    return z > 0.0f;
  });
  const std::vector<SliceOutput> outputs{
      {"out", (first + second + third + fourth + fifth + sin(x)).ref()}};
  return slice(recorder.program(), "nested", outputs);
}

TEST(ExpandMath, ExpandsInRegionsFunctionsAndLoops) {
  const Columns inputs{{"x", grid(-3.0f, 2.0f, 997)}, {"y", {1.5f}}};
  const std::vector<double> want = run_double(*make_reference(nested()), inputs).at("out");
  for (const Accuracy mode : {Accuracy::precise, Accuracy::standard}) {
    const Program program = expand_math(nested(), mode);
    EXPECT_EQ(verify(program), "");
    for (const Function& function : program.functions) {
      for (const Instruction& each : function.code) EXPECT_FALSE(is_transcendental(each.op));
    }
    const std::vector<float> got = run(*make_interpreter(program), inputs).at("out");
    for (std::size_t i = 0; i < got.size(); ++i) {
      ASSERT_NEAR(static_cast<double>(got[i]), want[i], 2e-5 * (1.0 + std::fabs(want[i])))
          << inputs.at("x")[i];
    }
    // Another pass may come after this one.
    EXPECT_EQ(verify(expand_math(program, mode)), "");
  }
}

TEST(ExpandMath, ModesGetCheaper) {
  for (int number = 0; number < op_count; ++number) {
    const Op op = static_cast<Op>(number);
    if (!is_transcendental(op)) continue;
    std::array<std::size_t, 3> sizes{};
    for (std::size_t i = 0; i < modes.size(); ++i) {
      const Program program = expand_math(program_of(op), modes[i]);
      for (const Function& function : program.functions) sizes[i] += function.code.size();
    }
    EXPECT_GT(sizes[0], sizes[1]) << info(op).name;
    EXPECT_GT(sizes[1], sizes[2]) << info(op).name;
  }
}

}  // namespace
}  // namespace nacre
