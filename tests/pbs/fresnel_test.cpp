#include "pbs/fresnel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "runtime/interpreter/interpreter.h"
#include "tests/support/random.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

using Complex = std::complex<double>;

/// Fresnel's formulas as they stand, Snell's law in complex numbers.
double fresnel(double cosine, Complex index) {
  const Complex out = std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index));
  const Complex s = (cosine - index * out) / (cosine + index * out);
  const Complex p = (index * cosine - out) / (index * cosine + out);
  return 0.5 * (std::norm(s) + std::norm(p));
}

Columns grid(const std::vector<float>& a, const std::vector<float>& b) {
  Columns out;
  for (const float x : a) {
    for (const float y : b) out["c"].push_back(x), out["eta"].push_back(y);
  }
  return out;
}

DoubleColumns dielectric(const Columns& inputs) {
  return evaluate(inputs, [](Recorder& r) {
    return std::vector<SliceOutput>{
        {"f", fresnel_dielectric(input(r, "c"), input(r, "eta")).ref()}};
  });
}

TEST(Fresnel, DielectricIsFresnelsFormula) {
  const Columns in = grid({0.01f, 0.1f, 0.3f, 0.5f, 0.7f, 0.9f, 1.0f},
                          {0.4f, 0.66f, 0.99f, 1.001f, 1.05f, 1.33f, 1.5f, 2.5f, 40.0f});
  const auto f = dielectric(in).at("f");
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double expected = fresnel(in.at("c")[i], in.at("eta")[i]);
    EXPECT_NEAR(f[i], expected, 1e-9 * expected) << in.at("c")[i] << " " << in.at("eta")[i];
  }
}

TEST(Fresnel, DielectricAtMarkedAngles) {
  const float brewster = std::cos(std::atan(1.5f));
  const auto f = dielectric({{"c", {1.0f, 0.0f, brewster, 0.7f, 0.5f, 0.0f}},
                             {"eta", {1.5f, 1.5f, 1.5f, 1 / 1.5f, 1.0f, 1.0f}}})
                     .at("f");
  EXPECT_NEAR(f[0], 0.04, 1e-9);
  EXPECT_NEAR(f[1], 1.0, 1e-12);
  // Only s at Brewster's angle: half of ((n^2 - 1) / (n^2 + 1))^2.
  EXPECT_NEAR(f[2], 0.5 * std::pow(1.25 / 3.25, 2), 1e-6);
  EXPECT_EQ(f[3], 1.0);  // Beyond 41.8 degrees from inside.
  EXPECT_EQ(f[4], 0.0);
  EXPECT_EQ(f[5], 0.0);
}

TEST(Fresnel, NothingIsTotallyReflectedByNoInterface) {
  const auto out =
      evaluate({{"c", {0.0f, 0.0f, 0.1f}}, {"eta", {1.0f, 0.9f, 0.9f}}}, [](Recorder& r) {
        const Bool total = totally_reflected(input(r, "c"), input(r, "eta"));
        return std::vector<SliceOutput>{{"total", select(total, Float(1.0f), Float(0.0f)).ref()}};
      });
  EXPECT_EQ(out.at("total"), (std::vector<double>{0.0, 1.0, 1.0}));
}

TEST(Fresnel, ConductorIsFresnelsFormula) {
  const std::vector<double> cosines{0.001, 0.1, 0.4, 0.8, 1.0};
  const std::vector<Complex> indices{{0.18, 3.42}, {1.37, 1.77}, {1.5, 0.0},  {0.2, 0.0},
                                     {2.9, 3.1},   {1e-3, 9},    {1e4, 1e4},  {0.0, 2.0},
                                     {1.0, 1e-4},  {50, 0.1},    {0.05, 1.02}};
  for (const double c : cosines) {
    for (const Complex index : indices) {
      const auto out = evaluate({{"c", {static_cast<float>(c)}}}, [&](Recorder& r) {
        return std::vector<SliceOutput>{
            {"f",
             fresnel_conductor_polarised(input(r, "c"), index.real(), index.imag()).mean().ref()}};
      });
      const double expected = fresnel(static_cast<float>(c), {static_cast<float>(index.real()),
                                                              static_cast<float>(index.imag())});
      EXPECT_NEAR(out.at("f")[0], expected, 1e-7) << c << " " << index;
    }
  }
}

// Of float kernels: black metal would be white at grazing angles if n^2 - sin^2 were taken apart.
TEST(Fresnel, ConductorKeepsItsDigitsNearNoInterface) {
  Random random(1);
  const auto number = [&] { return static_cast<float>(random.word() >> 40) * 0x1p-24f; };
  Columns in{{"c", {1e-4f, 1e-3f, 0.5f}}, {"n", {1, 1, 1}}, {"k", {0, 0, 0}}};
  for (int i = 0; i < 20'000; ++i) {
    in["c"].push_back(std::pow(10.0f, -4.5f * number()));
    in["n"].push_back(1.0f + (number() - 0.5f) * std::pow(10.0f, -6.0f * number()));
    in["k"].push_back(std::pow(10.0f, -2.0f - 6.0f * number()));
  }
  Recorder recorder;
  const Float f =
      fresnel_conductor_polarised(input(recorder, "c"), input(recorder, "n"), input(recorder, "k"))
          .mean();
  const std::vector<SliceOutput> outputs{{"f", f.ref()}};
  const auto kernel = make_interpreter(slice(recorder.program(), "test", outputs));
  const auto found = run(*kernel, in).at("f");
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double expected = fresnel(in["c"][i], {in["n"][i], in["k"][i]});
    EXPECT_NEAR(found[i], expected, 5e-6) << in["c"][i] << " " << in["n"][i] << " " << in["k"][i];
  }
  // Black metals are made of these indices: (a - cos)^2 had been 1e-16.
  std::ranges::fill(in["n"], 1.0f), std::ranges::fill(in["k"], 0.0f);
  const std::vector<float> black = run(*kernel, in).at("f");
  for (const float none : black) EXPECT_EQ(none, 0.0f);
}

TEST(Fresnel, ConductorWithoutAnIndexReflectsEverything) {
  const auto out = evaluate({{"c", {0.0f, 0.3f, 1.0f}}, {"k", {0.0f}}}, [&](Recorder& r) {
    const Float none = input(r, "k");
    return std::vector<SliceOutput>{
        {"f", fresnel_conductor_polarised(input(r, "c"), none, none).mean().ref()}};
  });
  for (const double f : out.at("f")) EXPECT_EQ(f, 1.0);
}

TEST(Fresnel, SchlickMeetsItsThreeColours) {
  const float c82 = 1.0f / 7.0f;
  const auto out = evaluate({{"c", {1.0f, c82, 0.0f}}, {"zero", {0.0f}}}, [&](Recorder& r) {
    const Float zero = input(r, "zero");  // So that nothing folds.
    const SchlickCurve curve(Color3(0.9f, 0.5f, 0.1f) + Color3(zero), Color3(0.6f, 1.0f, 0.2f),
                             Color3(1.0f, 0.8f, 0.3f), 5.0f + zero);
    const Color3 f = curve.at(input(r, "c"));
    return std::vector<SliceOutput>{{"x", f.x.ref()}, {"y", f.y.ref()}, {"z", f.z.ref()}};
  });
  EXPECT_NEAR(out.at("x")[0], 0.9, 1e-6);
  EXPECT_NEAR(out.at("z")[2], 0.3, 1e-6);
  const double at82 = std::pow(6.0 / 7.0, 5);
  EXPECT_NEAR(out.at("x")[1], 0.6 * (0.9 + 0.1 * at82), 1e-6);
  EXPECT_NEAR(out.at("y")[1], 0.5 + 0.3 * at82, 1e-6);
}

TEST(Fresnel, SchlickMeanIsItsIntegral) {
  for (const float exponent : {0.0f, 1.0f, 5.0f, 7.5f}) {
    Columns in;
    const int n = 4000;
    for (int i = 0; i < n; ++i) in["c"].push_back((static_cast<float>(i) + 0.5f) / n);
    const auto out = evaluate(in, [&](Recorder& r) {
      const SchlickCurve curve(Color3(0.9f), Color3(0.7f), Color3(1.0f), exponent);
      return std::vector<SliceOutput>{{"f", curve.at(input(r, "c")).x.ref()},
                                      {"mean", (curve.mean().x + 0.0f * input(r, "c")).ref()}};
    });
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += 2.0 * out.at("f")[i] * in.at("c")[i] / n;
    EXPECT_NEAR(out.at("mean")[0], sum, 1e-4) << exponent;
  }
}

TEST(Fresnel, IndexAndReflectanceAreInverse) {
  const auto out = evaluate({{"f", {0.01f, 0.04f, 0.5f, 0.99f}}}, [](Recorder& r) {
    return std::vector<SliceOutput>{
        {"f", reflectance_of_index(index_of_reflectance(input(r, "f"))).ref()}};
  });
  EXPECT_NEAR(out.at("f")[1], 0.04f, 1e-9);
  EXPECT_NEAR(out.at("f")[3], 0.99f, 1e-9);
}

}  // namespace
}  // namespace nacre
