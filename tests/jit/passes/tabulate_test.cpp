#include "jit/passes/tabulate/tabulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "jit/passes/tabulate/axis.h"
#include "runtime/interpreter/interpreter.h"
#include "runtime/program/digest.h"
#include "runtime/value/vector.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

using Body = std::function<std::vector<SliceOutput>(Recorder& recorder, Float x)>;

/// Of the input x in [low, high].
Program program_of(float low, float high, const Body& body) {
  Recorder recorder;
  const std::vector<SliceOutput> outputs =
      body(recorder, min(max(input(recorder, "x"), low), high));
  return slice(recorder.program(), "test", outputs);
}

std::size_t count(const Program& program, Op op) {
  return static_cast<std::size_t>(std::ranges::count(program.entry().code, op, &Instruction::op));
}

std::vector<float> numbers(float low, float high) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> number(low, high);
  std::vector<float> all{low, high};
  for (int i = 0; i < 20'000; ++i) all.push_back(number(random));
  return all;
}

/// How far the output y of a Program is from a function, in the terms of tabulate().
double error_of(const Program& program, float low, float high,
                const std::function<double(double)>& exact) {
  const std::vector<float> x = numbers(low, high);
  const std::vector<float> y = run(*make_interpreter(program), {{"x", x}}).at("y");
  double peak = 0, worst = 0;
  for (const float each : x) peak = std::max(peak, std::abs(exact(each)));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double expected = exact(x[i]);
    const double off = std::abs(y[i] - expected) / std::max(std::abs(expected), 0.01 * peak);
    worst = std::max(worst, off);
  }
  return worst;
}

/// Fresnel's factor of n + i k (Born and Wolf, Principles of Optics, 14.2), complex as it stands.
double fresnel(double cosine, double n, double k) {
  const std::complex<double> eta(n, k);
  const std::complex<double> inside = std::sqrt(eta * eta - (1 - cosine * cosine));
  const auto s = (cosine - inside) / (cosine + inside);
  const auto p = (eta * eta * cosine - inside) / (eta * eta * cosine + inside);
  return 0.5 * (std::norm(s) + std::norm(p));
}

/// The same in reals, as kernels have it.
Float recorded_fresnel(Float cosine, float n, float k) {
  const Float c2 = cosine * cosine, s2 = 1.0f - c2;
  const Float real = n * n - k * k - s2;
  const Float length = sqrt(real * real + 4.0f * n * n * k * k);
  const Float a = sqrt(max(0.5f * (length + real), 0.0f));
  const Float rs = (length + c2 - 2.0f * a * cosine) / (length + c2 + 2.0f * a * cosine);
  const Float rp = rs * (c2 * length + s2 * s2 - 2.0f * a * cosine * s2) /
                   (c2 * length + s2 * s2 + 2.0f * a * cosine * s2);
  return 0.5f * (rs + rp);
}

struct Metal {
  const char* name;
  float n, k;
};
class TabulateMetal : public testing::TestWithParam<Metal> {};

TEST_P(TabulateMetal, KeepsItsErrorAndComputesLess) {
  const auto [name, n, k] = GetParam();
  const Program whole = program_of(0, 1, [&](Recorder&, Float x) {
    return std::vector<SliceOutput>{{"y", recorded_fresnel(x, n, k).ref()}};
  });
  const auto exact = [&](double x) { return fresnel(x, n, k); };
  ASSERT_LT(error_of(whole, 0, 1, exact), 1e-5) << "the Program is not that function";
  for (const double error : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const Program made = tabulate(whole, error);
    EXPECT_EQ(count(made, Op::div), 0u) << error;
    EXPECT_GT(count(made, Op::table), 0u) << error;
    EXPECT_LT(made.entry().code.size(), whole.entry().code.size()) << error;
    // The Program's own roundings are not the table's.
    EXPECT_LT(error_of(made, 0, 1, exact), error + 2e-6) << error;
  }
}

INSTANTIATE_TEST_SUITE_P(All, TabulateMetal,
                         testing::Values(Metal{"gold", 0.143f, 3.983f}, Metal{"brass", 0.52f, 2.4f},
                                         Metal{"aluminium", 1.34f, 7.47f},
                                         Metal{"chromium", 3.11f, 3.31f},
                                         Metal{"titanium", 2.54f, 3.43f}),
                         [](const auto& row) { return row.param.name; });

// Linear between the entries of a table that lie closer towards 0: cells have the same corners.
TEST(Tabulate, FindsTheCornersOfATable) {
  constexpr int entries = 24;
  constexpr double ratio = 0.158;
  std::vector<float> values;
  for (int i = 0; i < entries; ++i) values.push_back(std::cos(0.4f * static_cast<float>(i)));
  const Program whole = program_of(0, 1, [&](Recorder& recorder, Float x) {
    const Float share = min(x * float(1 + ratio) / (x + float(ratio)), 1.0f);
    const Float place = share * float(entries - 1);
    const Float cell = min(floor(place), float(entries - 2));
    const Int index = to_int(cell);
    const std::uint32_t table = recorder.table("t", values);
    const auto entry = [&](Int at) { return Float(record(Op::table, {at.ref()}, table)); };
    const Float low = entry(index), high = entry(index + 1);
    const Float between = low + (place - cell) * (high - low);
    return std::vector<SliceOutput>{{"y", sqrt(2.0f + exp(between) / (3.0f + between)).ref()}};
  });
  const auto exact = [&](double x) {
    const double place = x * (1 + ratio) / (x + ratio) * (entries - 1);
    const double cell = std::min(std::floor(place), entries - 2.0);
    const auto k = static_cast<std::size_t>(cell);
    const double between = values[k] + (place - cell) * (values[k + 1] - values[k]);
    return std::sqrt(2 + std::exp(between) / (3 + between));
  };
  const Program made = tabulate(whole, 1e-4);
  EXPECT_EQ(count(made, Op::exp), 0u);
  EXPECT_LT(error_of(made, 0, 1, exact), 1e-4 + 2e-6);
}

TEST(Tabulate, LeavesWhatNoTableIsCloseTo) {
  // A step in the middle of a cell, and more waves than there are cells.
  for (const Body& body : {
           Body([&](Recorder&, Float x) {
             return std::vector<SliceOutput>{
                 {"y", exp(x * select(x < 0.31f, Float(1.0f), Float(2.0f))).ref()}};
           }),
           Body([&](Recorder&, Float x) {
             return std::vector<SliceOutput>{{"y", sin(300.0f * x).ref()}};
           }),
       }) {
    const Program whole = program_of(0, 1, body);
    EXPECT_EQ(digest(tabulate(whole, 1e-3)), digest(whole));
  }
}

// What is smooth below a value that is not is looked up all the same.
TEST(Tabulate, LooksUpPartsOfWhatNoTableIsCloseTo) {
  const Program whole = program_of(0, 1, [](Recorder&, Float x) {
    const Float smooth = exp(x) / (1.0f + sqrt(1.0f + x));
    return std::vector<SliceOutput>{{"y", select(x < 0.31f, smooth, 2.0f * smooth).ref()}};
  });
  const Program made = tabulate(whole, 1e-4);
  EXPECT_EQ(count(made, Op::exp), 0u);
  EXPECT_LT(error_of(made, 0, 1,
                     [](double x) {
                       const double smooth = std::exp(x) / (1 + std::sqrt(1 + x));
                       return x < 0.31f ? smooth : 2 * smooth;
                     }),
            1e-4 + 2e-6);
}

// But not what is magnified on its way to what is asked for.
TEST(Tabulate, ComputesWhatIsMagnified) {
  const Program whole = program_of(0, 1, [](Recorder&, Float x) {
    const Float smooth = exp(x) / (1.0f + sqrt(1.0f + x));
    return std::vector<SliceOutput>{{"y", sin(2000.0f * smooth).ref()}};
  });
  EXPECT_EQ(digest(tabulate(whole, 1e-4)), digest(whole));
}

// Of a number with corners inside of cells, two of them with others, what is smooth in each.
TEST(Tabulate, LooksUpWhatDependsOnANumberOnTheWay) {
  const Program whole = program_of(0, 1, [](Recorder&, Float x) {
    const Float low = min(1.7f * x, 1.0f), high = max(1.0f - 1.3f * x, 0.0f);
    const Float y = recorded_fresnel(low, 0.2f, 3.5f) + recorded_fresnel(high, 1.5f, 7.6f);
    return std::vector<SliceOutput>{{"y", y.ref()}};
  });
  const Program made = tabulate(whole, 1e-5);
  EXPECT_EQ(count(made, Op::sqrt), 0u);
  EXPECT_LT(error_of(made, 0, 1,
                     [](double x) {
                       return fresnel(std::min(1.7 * x, 1.0), 0.2, 3.5) +
                              fresnel(std::max(1 - 1.3 * x, 0.0), 1.5, 7.6);
                     }),
            1e-5 + 2e-6);
}

// However many cells a table has, those that are parted are some of its own.
TEST(Tabulate, PartsTheEndOfAnyTable) {
  for (int cells = 1; cells <= 32; ++cells) {
    const Axis axis = with_dense_end({.cells = cells, .along = Axis::Along::given}, 32);
    EXPECT_GE(axis.dense_from, 0) << cells;
    EXPECT_LE(axis.dense_from, cells) << cells;
    EXPECT_LE(axis.cells, 32) << cells;
    EXPECT_EQ(axis.cells, axis.dense_from + axis.dense * (cells - axis.dense_from)) << cells;
  }
}

// Two tables of other numbers, the corners of which are not the same.
TEST(Tabulate, FindsTheCornersOfEachTable) {
  constexpr int entries = 16;
  const std::array<double, 2> ratios{0.07, 0.3};
  std::vector<float> values;
  for (int i = 0; i < entries; ++i) values.push_back(std::cos(0.6f * static_cast<float>(i)));
  const Program whole = program_of(0, 1, [&](Recorder& recorder, Float x) {
    const std::uint32_t table = recorder.table("t", values);
    Float sum = 0.0f;
    for (const double ratio : ratios) {
      const Float share = min(x * float(1 + ratio) / (x + float(ratio)), 1.0f);
      const Float place = share * float(entries - 1);
      const Float cell = min(floor(place), float(entries - 2));
      const Int index = to_int(cell);
      const auto entry = [&](Int at) { return Float(record(Op::table, {at.ref()}, table)); };
      const Float low = entry(index), high = entry(index + 1);
      sum = sum + exp(low + (place - cell) * (high - low));
    }
    return std::vector<SliceOutput>{{"y", sum.ref()}};
  });
  const auto exact = [&](double x) {
    double sum = 0;
    for (const double ratio : ratios) {
      const double place = x * (1 + ratio) / (x + ratio) * (entries - 1);
      const double cell = std::min(std::floor(place), entries - 2.0);
      const auto k = static_cast<std::size_t>(cell);
      sum += std::exp(values[k] + (place - cell) * (values[k + 1] - values[k]));
    }
    return sum;
  };
  const Program made = tabulate(whole, 1e-4);
  EXPECT_EQ(count(made, Op::exp), 0u);
  EXPECT_LT(error_of(made, 0, 1, exact), 1e-4 + 2e-6);
}

TEST(Tabulate, LeavesWhatIsCheapAndWhatIsUnbounded) {
  const Program cheap = program_of(0, 1, [](Recorder&, Float x) {
    return std::vector<SliceOutput>{{"y", (x * x * x + 1.0f).ref()}};
  });
  EXPECT_EQ(digest(tabulate(cheap, 1e-2)), digest(cheap));
  Recorder recorder;
  const Float x = input(recorder, "x");
  const std::vector<SliceOutput> outputs{{"y", (exp(x) / sqrt(x)).ref()}};
  const Program unbounded = slice(recorder.program(), "test", outputs);
  EXPECT_EQ(digest(tabulate(unbounded, 1e-2)), digest(unbounded));
}

// What several values share is computed once or looked up, each within its error; integers and
// what a table is not close to stay what they were.
TEST(Tabulate, LooksUpWhatItCanOfAGroup) {
  const Program whole = program_of(-1, 2, [](Recorder& recorder, Float x) {
    const Float other = input(recorder, "other");
    const Float shared = exp(-x * x);
    const Float smooth = sqrt(1.0f + shared) / (2.0f + log(2.0f + shared));
    const Float rough = sin(500.0f * shared);
    return std::vector<SliceOutput>{{"y", (smooth * other).ref()},
                                    {"rough", (rough + other).ref()},
                                    {"whole", to_int(10.0f * shared).ref()}};
  });
  const Program made = tabulate(whole, 1e-4);
  const std::vector<float> x = numbers(-1, 2);
  const Columns inputs{{"x", x}, {"other", {3.0f}}};
  // By the oracle, which knows exp and sin.
  const DoubleColumns before = run_double(*make_reference(whole), inputs);
  const DoubleColumns after = run_double(*make_reference(made), inputs);
  EXPECT_EQ(before.at("rough"), after.at("rough"));
  EXPECT_EQ(before.at("whole"), after.at("whole"));
  EXPECT_NE(before.at("y"), after.at("y"));
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double shared = std::exp(-double(x[i]) * x[i]);
    const double y = 3 * std::sqrt(1 + shared) / (2 + std::log(2 + shared));
    ASSERT_NEAR(after.at("y")[i], y, 1.1e-4 * y) << x[i];
  }
}

// As deep as a Program: nothing may go down it by calls.
TEST(Tabulate, LooksUpLongChains) {
  constexpr int depth = 20'000;
  const Program whole = program_of(0.5f, 1, [](Recorder& recorder, Float x) {
    const Float other = input(recorder, "other");
    for (int i = 0; i < depth; ++i) x = sin(x);
    return std::vector<SliceOutput>{{"y", (x * other).ref()}};
  });
  const Program made = tabulate(whole, 1e-3);
  EXPECT_EQ(count(made, Op::sin), 0u);
  const std::vector<float> y =
      run(*make_interpreter(made), {{"x", {0.5f, 0.8f, 1.0f}}, {"other", {1.0f}}}).at("y");
  for (std::size_t i = 0; i < 3; ++i) {
    double exact = std::array{0.5f, 0.8f, 1.0f}[i];
    for (int k = 0; k < depth; ++k) exact = std::sin(exact);
    EXPECT_NEAR(y[i], exact, 1e-3 * exact);
  }
}

// What is looked for is bounded, and does not hang on what was recorded first: of groups that save
// as much all are looked up, or none.
TEST(Tabulate, LeavesMoreThanItCanLookAtInTime) {
  const auto groups = [](int many) {
    return program_of(0, 1, [many](Recorder& recorder, Float x) {
      Float sum = x;
      for (int i = 0; i < many; ++i) {
        const Float bounded = min(max(sum * input(recorder, "y"), 0.0f), 1.0f);
        sum = sum + sqrt(exp(bounded) / (2.0f + bounded));
      }
      return std::vector<SliceOutput>{{"z", sum.ref()}};
    });
  };
  EXPECT_EQ(count(tabulate(groups(100), 1e-3), Op::exp), 0u);
  EXPECT_EQ(count(tabulate(groups(5000), 1e-3), Op::exp), 5000u);
}

TEST(Tabulate, TakesAnythingAsItsNumber) {
  const Program made = tabulate(
      program_of(0, 1,
                 [](Recorder&, Float x) {
                   return std::vector<SliceOutput>{{"y", recorded_fresnel(x, 0.2f, 3.5f).ref()}};
                 }),
      1e-4);
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> x{-infinity, -1e30f, -0.0f, 1e-40f, 1.0f, 2.0f, infinity, NAN};
  const std::vector<float> y = run(*make_interpreter(made), {{"x", x}}).at("y");
  for (std::size_t i = 0; i < x.size(); ++i) {
    // max(x, 0) of NaN is 0.
    const double at = std::isnan(x[i]) ? 0.0 : std::clamp(double(x[i]), 0.0, 1.0);
    EXPECT_NEAR(y[i], fresnel(at, 0.2, 3.5), 1e-4) << x[i];
  }
}

}  // namespace
}  // namespace nacre
