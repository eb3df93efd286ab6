#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/interpreter/interpreter.h"
#include "tests/nodes/node_runner.h"

namespace nacre {
namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
const float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float largest = std::numeric_limits<float>::max();

double unary(const char* category, float x) { return call_scalar(category, {{"in", x}}); }
double binary(const char* category, float a, float b) {
  return call_scalar(category, {{"in1", a}, {"in2", b}});
}

TEST(Math, DivisionIsFiniteOrZero) {
  EXPECT_EQ(binary("divide", 3.0f, 2.0f), 1.5);
  EXPECT_EQ(binary("divide", 1.0f, 0.0f), 0.0);
  EXPECT_EQ(binary("divide", 0.0f, 0.0f), 0.0);
  EXPECT_EQ(binary("divide", 1.0f, inf), 0.0);
  EXPECT_EQ(binary("divide", inf, 1.0f), 0.0);
  EXPECT_EQ(binary("divide", 1.0f, nan), 0.0);
}

TEST(Math, ModuloTakesTheSignOfTheDivisor) {
  EXPECT_EQ(binary("modulo", 5.5f, 2.0f), 1.5);
  EXPECT_EQ(binary("modulo", -5.5f, 2.0f), 0.5);
  EXPECT_EQ(binary("modulo", 5.5f, -2.0f), -0.5);
  EXPECT_EQ(binary("modulo", 4.0f, 2.0f), 0.0);
  EXPECT_EQ(binary("modulo", 7.25f, 0.0f), 7.25);
}

TEST(Math, ModuloStaysBelowTheDivisorInSinglePrecision) {
  const NodeUnderTest node{"modulo", {{"in1"}, {"in2"}}};
  std::vector<float> a;
  std::vector<float> b;
  for (const float x : {-1e-10f, -1e-30f, 2.9999998f, 1e9f, -1e9f, 16777215.0f, 1e30f, -7.1f}) {
    for (const float y : {1.0f, 0.1f, 3.0f, -0.3f, -1.0f, 1e-3f, 1e10f}) {
      a.push_back(x);
      b.push_back(y);
    }
  }
  const auto kernel = make_interpreter(node_program(node));
  const Columns out = run(*kernel, {{"in1", a}, {"in2", b}});
  for (std::size_t i = 0; i < a.size(); ++i) {
    const float m = out.at("out")[i];
    EXPECT_LT(std::fabs(m), std::fabs(b[i])) << a[i] << " mod " << b[i];
    EXPECT_TRUE(m == 0.0f || (m < 0.0f) == (b[i] < 0.0f)) << a[i] << " mod " << b[i];
  }
}

TEST(Math, PowerIsDefinedEverywhere) {
  EXPECT_EQ(binary("power", -2.0f, 3.0f), -8.0);
  EXPECT_EQ(binary("power", -2.0f, 0.5f), 0.0);
  EXPECT_EQ(binary("power", 0.0f, 0.0f), 1.0);
  EXPECT_EQ(binary("power", 0.0f, -1.0f), 0.0);
  EXPECT_EQ(binary("power", nan, 0.0f), 1.0);
  EXPECT_EQ(binary("power", 10.0f, 1000.0f), static_cast<double>(largest));
  EXPECT_NEAR(binary("power", 2.0f, 0.5f), std::sqrt(2.0), 1e-15);
}

TEST(Math, RootsAndLogarithmsOfWhatHasNone) {
  EXPECT_EQ(unary("sqrt", 9.0f), 3.0);
  EXPECT_EQ(unary("sqrt", -1.0f), 0.0);
  EXPECT_EQ(unary("sqrt", nan), 0.0);
  EXPECT_NEAR(unary("ln", 2.0f), std::log(2.0), 1e-15);
  EXPECT_NEAR(unary("ln", 0.0f), -87.3365447505, 1e-9);
  EXPECT_EQ(unary("ln", -5.0f), unary("ln", 0.0f));
  EXPECT_NEAR(unary("asin", 2.0f), M_PI / 2, 1e-15);
  EXPECT_NEAR(unary("acos", -3.0f), M_PI, 1e-15);
}

TEST(Math, RoundsHalvesAwayFromZero) {
  EXPECT_EQ(unary("round", 0.5f), 1.0);
  EXPECT_EQ(unary("round", -0.5f), -1.0);
  EXPECT_EQ(unary("round", 2.5f), 3.0);
  EXPECT_EQ(unary("round", 0.49999997f), 0.0);
  EXPECT_EQ(unary("round", 8388609.0f), 8388609.0);
  EXPECT_EQ(unary("round", -inf), -static_cast<double>(inf));
}

TEST(Math, IntegerRoundingClampsToTheRangeOfInt) {
  const auto whole = [](const char* category, float x) {
    return call_node(category, {{"in", Type::float_, {x}}}, Type::integer).front();
  };
  EXPECT_EQ(whole("floor", -2.5f), -3.0);
  EXPECT_EQ(whole("ceil", -2.5f), -2.0);
  EXPECT_EQ(whole("round", -2.5f), -3.0);
  EXPECT_EQ(whole("floor", 1e20f), 2147483647.0);
  EXPECT_EQ(whole("ceil", -inf), -2147483648.0);
  EXPECT_EQ(whole("round", nan), 0.0);
}

TEST(Math, FractStaysBelowOne) {
  EXPECT_EQ(unary("fract", 2.75f), 0.75);
  EXPECT_EQ(unary("fract", -0.25f), 0.75);
  const auto kernel = make_interpreter(node_program({"fract", {{"in"}}}));
  EXPECT_LT(run(*kernel, {{"in", {-1e-10f}}}).at("out")[0], 1.0f);
  EXPECT_TRUE(std::isnan(run(*kernel, {{"in", {inf}}}).at("out")[0]));
}

TEST(Math, ClampWithItsEndsTheWrongWayRoundIsTheLowEnd) {
  const auto clamped = [](float x, float low, float high) {
    return call_scalar("clamp", {{"in", x}, {"low", low}, {"high", high}});
  };
  EXPECT_EQ(clamped(0.5f, 0.0f, 1.0f), 0.5);
  EXPECT_EQ(clamped(-2.0f, 0.0f, 1.0f), 0.0);
  EXPECT_EQ(clamped(2.0f, 0.0f, 1.0f), 1.0);
  EXPECT_EQ(clamped(0.5f, 1.0f, 0.0f), 1.0);
}

TEST(Math, SignHasThreeValues) {
  EXPECT_EQ(unary("sign", 1e-30f), 1.0);
  EXPECT_EQ(unary("sign", -inf), -1.0);
  EXPECT_EQ(unary("sign", -0.0f), 0.0);
  EXPECT_EQ(unary("sign", nan), 0.0);
}

TEST(Math, IntegersWrap) {
  const auto kernel = make_interpreter(node_program(
      {"add", {{"in1", Type::integer}, {"in2", Type::integer}}, {{"out", Type::integer}}}));
  EXPECT_EQ(run(*kernel, {{"in1", {7.0f}}, {"in2", {-9.0f}}}).at("out")[0], -2.0f);
  EXPECT_EQ(run(*kernel, {{"in1", {-2147483648.0f}}, {"in2", {-2147483648.0f}}}).at("out")[0],
            0.0f);
}

TEST(Math, NormalizesVectorsOfAnyLength) {
  const auto kernel = make_interpreter(
      node_program({"normalize", {{"in", Type::vector3}}, {{"out", Type::vector3}}}));
  const std::vector<float> scales{1.0f, 1e-30f, 1e-37f, 1e18f, 1e30f, 1e38f};
  std::vector<float> x;
  std::vector<float> y;
  for (const float s : scales) {
    x.push_back(3.0f * s);
    y.push_back(-1.5f * s);
  }
  const Columns out = run(*kernel, {{"in.x", x}, {"in.y", y}, {"in.z", {0.0f}}});
  for (std::size_t i = 0; i < scales.size(); ++i) {
    EXPECT_NEAR(out.at("out.x")[i], 2.0 / std::sqrt(5.0), 2e-7) << scales[i];
    EXPECT_NEAR(out.at("out.y")[i], -1.0 / std::sqrt(5.0), 2e-7) << scales[i];
  }
  EXPECT_EQ(call_node("normalize", {{"in", Type::vector2, {0, 0}}}, Type::vector2),
            (std::vector<double>{0, 0}));
}

TEST(Math, MagnitudeNeitherOverflowsNorVanishes) {
  const auto kernel = make_interpreter(node_program({"magnitude", {{"in", Type::vector4}}}));
  const auto of = [&](float s) {
    return run(*kernel, {{"in.x", {s}}, {"in.y", {-s}}, {"in.z", {s}}, {"in.w", {s}}}).at("out")[0];
  };
  EXPECT_FLOAT_EQ(of(1.0f), 2.0f);
  EXPECT_FLOAT_EQ(of(1e38f), 2e38f);
  EXPECT_FLOAT_EQ(of(1e-37f), 2e-37f);
  EXPECT_EQ(of(0.0f), 0.0f);
}

TEST(Math, RotatesClockwiseByDegrees) {
  const auto turned = [](float degrees) {
    return call_node("rotate2d",
                     {{"in", Type::vector2, {1, 0}}, {"amount", Type::float_, {degrees}}},
                     Type::vector2);
  };
  EXPECT_NEAR(turned(90.0f)[0], 0.0, 1e-7);
  EXPECT_NEAR(turned(90.0f)[1], -1.0, 1e-7);
  // 36000 turns and 45 degrees, a number that a float has.
  EXPECT_NEAR(turned(360.0f * 36000.0f + 45.0f)[0], std::sqrt(0.5), 1e-7);
}

TEST(Math, RotationAboutAnAxisKeepsLengthAndAxis) {
  const std::vector<Arg> args{{"in", Type::vector3, {1, 2, 3}},
                              {"amount", Type::float_, {120}},
                              {"axis", Type::vector3, {2, 2, 2}}};
  const std::vector<double> v = call_node("rotate3d", args, Type::vector3);
  // A third of a turn about the diagonal permutes the axes.
  EXPECT_NEAR(v[0], 2.0, 1e-6);
  EXPECT_NEAR(v[1], 3.0, 1e-6);
  EXPECT_NEAR(v[2], 1.0, 1e-6);
}

}  // namespace
}  // namespace nacre
