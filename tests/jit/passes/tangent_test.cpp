#include "jit/passes/tangent.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/jit/passes/derivative_check.h"

namespace nacre {
namespace {

struct RuleCase {
  const char* name;
  Float (*body)(Float u, Float v);
};

/// u and v in (0.1, 0.9), so every function is smooth at the generic points.
const std::vector<RuleCase>& rule_cases() {
  static const std::vector<RuleCase> cases{
      {"add", [](Float u, Float v) { return u + v; }},
      {"add_constant", [](Float u, Float) { return u + 3.0f; }},
      {"sub", [](Float u, Float v) { return u - v; }},
      {"sub_from_constant", [](Float u, Float) { return 1.0f - u; }},
      {"mul", [](Float u, Float v) { return u * v; }},
      {"mul_same", [](Float u, Float) { return u * u; }},
      {"div", [](Float u, Float v) { return u / v; }},
      {"div_of_constant", [](Float u, Float) { return 2.0f / u; }},
      {"div_by_constant", [](Float u, Float) { return u / 3.0f; }},
      {"fma", [](Float u, Float v) { return fma(u, v, u); }},
      {"fma_constant", [](Float u, Float v) { return fma(u, 3.0f, v); }},
      {"min", [](Float u, Float v) { return min(u * u, v); }},
      {"max", [](Float u, Float v) { return max(u * u, v); }},
      {"sqrt", [](Float u, Float v) { return sqrt(u + v); }},
      {"neg", [](Float u, Float) { return -u; }},
      {"abs_above", [](Float u, Float v) { return abs(u + v); }},
      {"abs_below", [](Float u, Float v) { return abs(u - v * 8.0f); }},
      {"select", [](Float u, Float v) { return select(u < v, u * v, v); }},
      {"copysign", [](Float u, Float v) { return copysign(u * u, v - 0.5f); }},
      {"xor_sign",
       [](Float u, Float v) {
         return float_of_bits(bits_of(u) ^ (bits_of(v - 0.5f) & Int(INT32_MIN)));
       }},
      {"flip_sign", [](Float u, Float) { return float_of_bits(bits_of(u) ^ Int(INT32_MIN)); }},
      {"clear_sign",
       [](Float u, Float) { return float_of_bits(bits_of(u - 0.5f) & Int(INT32_MAX)); }},
      {"sin", [](Float u, Float v) { return sin(u * v * 5.0f); }},
      {"cos", [](Float u, Float v) { return cos(u * v * 5.0f); }},
      {"tan", [](Float u, Float v) { return tan(u * v); }},
      {"asin", [](Float u, Float v) { return asin(u * v); }},
      {"acos", [](Float u, Float v) { return acos(u * v); }},
      {"atan2_steep", [](Float u, Float v) { return atan2(u + 1.0f, v); }},
      {"atan2_flat", [](Float u, Float v) { return atan2(u, v - 2.0f); }},
      {"atan2_of_constant", [](Float u, Float) { return atan2(0.5f, u); }},
      {"exp", [](Float u, Float v) { return exp(u - v); }},
      {"exp2", [](Float u, Float v) { return exp2(u - v); }},
      {"log", [](Float u, Float v) { return log(u + v); }},
      {"log2", [](Float u, Float v) { return log2(u + v); }},
      {"pow", [](Float u, Float v) { return pow(u, v); }},
      {"pow_of_base", [](Float u, Float) { return pow(u, 2.5f); }},
      {"pow_of_exponent", [](Float, Float v) { return pow(3.0f, v); }},
      {"pow_of_negative_base", [](Float u, Float) { return pow(-u, 3.0f); }},
      {"fract", [](Float u, Float v) { return fract(u * 3.0f) * v; }},
  };
  return cases;
}

TEST(TangentRules, AgreeWithCentralDifferences) {
  for (const RuleCase& rule : rule_cases()) {
    SCOPED_TRACE(rule.name);
    expect_derivative([&](Recorder&, Float u, Float v) { return rule.body(u, v); });
  }
}

TEST(TangentRules, EveryOperationWithARuleIsTested) {
  for (int number = 0; number < op_count; ++number) {
    const Op op = static_cast<Op>(number);
    if (tangent_rule(op) == nullptr) continue;
    bool found = false;
    for (const RuleCase& rule : rule_cases()) {
      const Program program =
          record_body([&](Recorder&, Float u, Float v) { return rule.body(u, v); });
      for (const Instruction& instruction : program.entry().code) {
        found = found || instruction.op == op;
      }
    }
    EXPECT_TRUE(found) << info(op).name;
  }
}

TEST(TangentRules, PiecewiseConstantFunctionsAskForNothing) {
  const std::vector<float> values{1.0f, 5.0f, 2.0f};
  const std::vector<Body> bodies{
      [](Recorder&, Float u, Float) { return floor(u * 9.0f); },
      [](Recorder&, Float u, Float) { return ceil(u * 9.0f); },
      [](Recorder&, Float u, Float) { return trunc(u * 9.0f); },
      [](Recorder&, Float u, Float) { return round(u * 9.0f); },
      [](Recorder&, Float u, Float) { return to_float(to_int(u * 9.0f)); },
      [](Recorder&, Float u, Float) { return to_float_unsigned(to_int(u * 9.0f)); },
      [](Recorder&, Float u, Float v) { return to_float(u < v); },
      [](Recorder&, Float u, Float) { return float_of_bits(bits_of(u) + Int(1)); },
      [](Recorder&, Float u, Float) { return half_to_float(bits_of(u)); },
      [&](Recorder& recorder, Float u, Float) {
        const std::uint32_t table = recorder.table("t", values);
        return Float(record(Op::table, {to_int(u * 9.0f).ref()}, table));
      },
  };
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Program derived = derivative_of(bodies[i], 0);
    EXPECT_TRUE(derived.inputs.empty()) << i << "\n" << to_string(derived);
    EXPECT_EQ(derived.entry().code.size(), 2u) << i << "\n" << to_string(derived);
  }
}

TEST(TangentRules, PolynomialIsExact) {
  // d/dx (u^3 - 2 u v + v^2) = (3 u^2 - 2 v) du + (2 v - 2 u) dv; all in few bits.
  const auto derived = make_reference(derivative_of(
      [](Recorder&, Float u, Float v) { return u * u * u - 2.0f * u * v + v * v; }, 0));
  for (const FootprintPoint& p : generic_points()) {
    const double u = static_cast<double>(p.u);
    const double v = static_cast<double>(p.v);
    EXPECT_EQ(evaluate(*derived, p), (3 * u * u - 2 * v) * static_cast<double>(p.dudx) +
                                         (2 * v - 2 * u) * static_cast<double>(p.dvdx));
  }
}

TEST(TangentRules, SingularPointsGiveZero) {
  struct Case {
    const char* name;
    Float (*body)(Float u, Float v);
  };
  const std::vector<Case> cases{
      {"sqrt at 0", [](Float u, Float) { return sqrt(u); }},
      {"sqrt below 0", [](Float u, Float) { return sqrt(u - 1.0f); }},
      {"1 / 0", [](Float u, Float) { return 1.0f / u; }},
      {"0 / 0", [](Float u, Float) { return u / u; }},
      {"log at 0", [](Float u, Float) { return log(u); }},
      {"log2 below 0", [](Float u, Float) { return log2(u - 1.0f); }},
      {"asin at 1", [](Float, Float v) { return asin(v); }},
      {"acos beyond 1", [](Float, Float v) { return acos(v + 1.0f); }},
      {"atan2 at the origin", [](Float u, Float v) { return atan2(u, v - 1.0f); }},
      {"pow(0, 0.5)", [](Float u, Float) { return pow(u, 0.5f); }},
      {"pow(0, -1)", [](Float u, Float) { return pow(u, -1.0f); }},
      {"pow(0, 0)", [](Float u, Float) { return pow(u, 0.0f); }},
      {"pow(0, v) by v", [](Float, Float v) { return pow(0.0f, v); }},
      {"a^b, a < 0", [](Float, Float v) { return pow(-2.0f, v); }},
      {"exp overflow", [](Float u, Float v) { return exp((u + v) * 1e5f); }},
      {"infinite slope inside", [](Float u, Float) { return sqrt(u) * sqrt(u); }},
  };
  const FootprintPoint point{0.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
  for (const Case& c : cases) {
    const auto derived =
        make_reference(derivative_of([&](Recorder&, Float u, Float v) { return c.body(u, v); }, 0));
    EXPECT_EQ(evaluate(*derived, point), 0.0) << c.name << "\n" << to_string(derived->program());
  }
}

TEST(TangentRules, SingularTermLeavesTheOthers) {
  const auto derived = make_reference(
      derivative_of([](Recorder&, Float u, Float v) { return sqrt(u) + 2.0f * v; }, 0));
  EXPECT_EQ(evaluate(*derived, {0.0f, 1.0f, 1.0f, 0.25f, 0.0f, 0.0f}), 0.5);
}

TEST(TangentRules, PowerOfZeroHasItsSlope) {
  const FootprintPoint point{0.0f, 1.0f, 3.0f, 0.0f, 0.0f, 0.0f};
  const auto linear =
      make_reference(derivative_of([](Recorder&, Float u, Float v) { return pow(u, v); }, 0));
  EXPECT_EQ(evaluate(*linear, point), 3.0);  // d u^1 = du
  const auto square =
      make_reference(derivative_of([](Recorder&, Float u, Float) { return pow(u, 2.0f); }, 0));
  EXPECT_EQ(evaluate(*square, point), 0.0);
}

TEST(TangentRules, AngleOfShortAndLongVectors) {
  // atan2 depends on the direction only: its derivative scales as 1 / length.
  for (const double scale : {0x1p-70, 0x1p-3, 0x1p70}) {
    const auto s = static_cast<float>(scale);
    const auto derived =
        make_reference(derivative_of([](Recorder&, Float u, Float v) { return atan2(u, v); }, 0));
    const FootprintPoint point{3.0f * s, 4.0f * s, 1.0f, 0.0f, 0.0f, 0.0f};
    EXPECT_NEAR(evaluate(*derived, point) * scale, 4.0 / 25.0, 1e-15);
  }
}

/// A smooth expression of u and v; every intermediate value stays within a few
/// units of 0, and away from the kinks with high probability.
Float random_expression(std::mt19937& random, Float u, Float v, int depth) {
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  if (depth == 0) {
    const int leaf = pick(3);
    return leaf == 0 ? u : leaf == 1 ? v : Float(0.25f + 0.125f * static_cast<float>(pick(12)));
  }
  const Float a = random_expression(random, u, v, depth - 1);
  const Float b = random_expression(random, u, v, depth - 1);
  switch (pick(14)) {
    case 0: return a + b;
    case 1: return a - b;
    case 2: return a * b;
    case 3: return a / (1.0f + b * b);
    case 4: return fma(a, b, u);
    case 5: return sqrt(1.0f + a * a);
    case 6: return sin(a);
    case 7: return cos(b);
    case 8: return exp(-(a * a));
    case 9: return log(1.5f + cos(a));
    case 10: return atan2(a, 1.0f + b * b);
    case 11: return asin(0.5f * sin(a));
    case 12: return pow(1.5f + sin(a), cos(b));
    default: return select(u < v, a, b);
  }
}

TEST(TangentRules, ComposeIntoTheChainRule) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_derivative([&](Recorder&, Float u, Float v) {
      std::mt19937 random(seed);
      return random_expression(random, u, v, 4);
    });
  }
}

}  // namespace
}  // namespace nacre
