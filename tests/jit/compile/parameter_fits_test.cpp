#include "jit/compile/parameter_fits.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <complex>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "jit/compile/compile.h"
#include "jit/service/compile_service.h"
#include "pbs/fresnel.h"
#include "runtime/program/recorder.h"
#include "runtime/program/serialize.h"
#include "runtime/program/slice.h"
#include "runtime/value/control.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

constexpr std::size_t points = 1000;

struct Made {
  std::shared_ptr<const Kernel> kernel;
  std::shared_ptr<const ParameterFits> fits;
};

std::vector<float> cosines() {
  std::vector<float> all;
  for (std::size_t i = 0; i < points; ++i) all.push_back((float(i) + 0.37f) / points);
  return all;
}

std::vector<std::uint32_t> bits_of(const std::vector<float>& numbers) {
  std::vector<std::uint32_t> bits;
  for (const float number : numbers) bits.push_back(std::bit_cast<std::uint32_t>(number));
  return bits;
}

/// What a kernel of one input "x" and one output gives; `fitted` may be null.
std::vector<float> run(const Kernel& kernel, const std::vector<float>& x,
                       const std::vector<std::uint32_t>& parameters, const float* fitted) {
  std::vector<float> result(x.size());
  const void* const input = x.data();
  void* const output = result.data();
  KernelArguments arguments;
  arguments.inputs = &input;
  arguments.outputs = &output;
  arguments.parameters = parameters.data();
  arguments.fitted = fitted;
  arguments.count = x.size();
  EXPECT_EQ(kernel.run(arguments), RunStatus::done);
  return result;
}

std::vector<float> run(const Made& made, const std::vector<float>& x,
                       const std::vector<float>& parameters) {
  if (made.fits == nullptr) return {};
  const auto bits = bits_of(parameters);
  const auto fitted = made.fits->of(bits);
  return run(*made.kernel, x, bits, fitted->data());
}

class FitParameters : public testing::Test {
 protected:
  FitParameters() {
    options_.fits_slot = [](std::string_view) { return true; };
  }

  /// `f(x, parameters)` of x in [0, 1], as a Program.
  template <class F>
  static Program program_of(const std::vector<std::string>& names, F&& f) {
    Recorder recorder;
    const Float x = saturate(Float(recorder.input("x", Scalar::f32)));
    std::vector<Float> parameters;
    for (const std::string& name : names) {
      parameters.emplace_back(recorder.parameter(name, Scalar::f32, 0));
    }
    const Float value = f(x, parameters);
    return slice(recorder.program(), "test", std::vector<SliceOutput>{{"y", value.ref()}});
  }
  Made make(const Program& program) { return make(program, *service_); }
  Made make(const Program& program, CompileService& service) {
    Diagnostics said;
    Made made{compile(program, options_, &service, said), nullptr};
    EXPECT_FALSE(said.has_errors());
    made.fits = ParameterFits::make(*made.kernel);
    return made;
  }
  /// What a metal reflects in three channels, of one index times 1, 1.5 and 2.
  static Program metal(const std::string& n = "n", const std::string& k = "k") {
    return program_of({n, k}, [](Float x, const std::vector<Float>& p) {
      const Float index = clamp(p[0], 0.0f, 1e3f), extinction = clamp(p[1], 0.0f, 1e3f);
      const Color3 f =
          fresnel_conductor(x, Color3(index, 1.5f * index, 2.0f * index), Color3(extinction));
      return f.x + f.y + f.z;
    });
  }

  Diagnostics said_;
  std::shared_ptr<CompileService> service_ = CompileService::create({}, said_);
  CompileOptions options_;
};

/// Fresnel's formulas by complex numbers, which the node's body does not use.
double reflectance(double cosine, std::complex<double> index) {
  const std::complex<double> sine2 = 1.0 - cosine * cosine;
  const std::complex<double> inside = std::sqrt(index * index - sine2);
  const auto s = (cosine - inside) / (cosine + inside);
  const auto p = (index * index * cosine - inside) / (index * index * cosine + inside);
  return 0.5 * (std::norm(s) + std::norm(p));
}

TEST_F(FitParameters, ReflectancesOfMetalsAreReadWhateverTheirIndices) {
  const Made made = make(metal());
  ASSERT_NE(made.fits, nullptr);
  const std::vector<float> x = cosines();
  for (const auto& [n, k] :
       {std::pair{0.143f, 3.983f}, {1.44f, 7.0f}, {0.05f, 2.1f}, {3.0f, 3.3f}}) {
    EXPECT_EQ(made.fits->of(bits_of({n, k}))->data()[0], 1.0f) << n << ' ' << k;
    const std::vector<float> y = run(made, x, {n, k});
    double worst = 0;
    for (std::size_t i = 0; i < points; ++i) {
      double exact = 0;
      for (const double times : {1.0, 1.5, 2.0}) {
        exact += reflectance(double{x[i]}, {times * double{n}, double{k}});
      }
      worst = std::max(worst, std::abs(double{y[i]} - exact) / exact);
    }
    EXPECT_LT(worst, 5e-5) << n << ' ' << k;
  }
}

/// A wave that fits where it is long, and has more crests than there are cells where it is short.
TEST_F(FitParameters, WhatDoesNotFitIsComputed) {
  const Program wave = program_of({"frequency"}, [](Float x, const std::vector<Float>& p) {
    return sin(x * p[0]) * exp(-x) + cos(x * p[0]);
  });
  options_.fits_slot = {};
  const Made plain = make(wave);
  options_.fits_slot = [](std::string_view) { return true; };
  const Made made = make(wave);
  ASSERT_NE(made.fits, nullptr);
  const std::vector<float> x = cosines();
  const auto is_read = [&](float frequency) {
    const auto bits = bits_of({frequency});
    const std::vector<float> exact = run(*plain.kernel, x, bits, nullptr);
    const std::vector<float> found = run(made, x, {frequency});
    double worst = 0;
    for (std::size_t i = 0; i < points; ++i) {
      worst = std::max(worst, std::abs(double{found[i]} - exact[i]));
    }
    EXPECT_LT(worst, 5e-5);
    return found != exact;
  };
  EXPECT_TRUE(is_read(1.3f));
  EXPECT_FALSE(is_read(200.0f));
  EXPECT_TRUE(is_read(0.9f));
}

TEST_F(FitParameters, WithoutFitsAllIsComputed) {
  options_.fits_slot = {};
  const Made plain = make(metal());
  EXPECT_EQ(plain.fits, nullptr);
  options_.fits_slot = [](std::string_view) { return true; };
  const Made made = make(metal());
  const std::vector<float> x = cosines();
  const auto bits = bits_of({0.2f, 3.0f});
  EXPECT_EQ(run(*made.kernel, x, bits, nullptr), run(*plain.kernel, x, bits, nullptr));
}

TEST_F(FitParameters, EnginesAndWidthsAgree) {
  const std::vector<float> x = cosines();
  std::vector<std::vector<float>> all;
  for (const int lanes : {1, 4, 8, 16}) {
    options_.lanes = lanes;
    all.push_back(run(make(metal()), x, {0.4f, 2.4f}));
  }
  options_.backend = Backend::interpreter;
  all.push_back(run(make(metal()), x, {0.4f, 2.4f}));
  for (const std::vector<float>& each : all) EXPECT_EQ(each, all.front());
}

TEST_F(FitParameters, CodeFromACacheKnowsWhatToFit) {
  const TemporaryFolder folder;
  ServiceOptions cached;
  cached.cache = folder.path() / "kernels";
  const auto service = [&] {
    return std::shared_ptr<CompileService>(CompileService::create(cached, said_));
  };
  const std::vector<float> x = cosines();
  const std::vector<float> first = run(make(metal(), *service()), x, {1.2f, 5.0f});
  const auto second = service();
  const Made made = make(metal(), *second);
  const auto* kernel = dynamic_cast<const CompiledKernel*>(made.kernel.get());
  ASSERT_NE(kernel, nullptr);
  ASSERT_TRUE(kernel->stats().from_cache);
  ASSERT_NE(made.fits, nullptr);
  EXPECT_EQ(run(made, x, {1.2f, 5.0f}), first);
}

/// Programs that differ in names and values alone share their code.
TEST_F(FitParameters, CodeIsSharedByProgramsWhoseSlotsHaveOtherNames) {
  const Program other = metal("index", "extinction");
  const std::vector<float> x = cosines();
  const Made a = make(metal()), b = make(other);
  // Which was found, and not lowered.
  EXPECT_NE(a.kernel->program().fitted_rows, 0u);
  EXPECT_EQ(b.kernel->program().fitted_rows, 0u);
  ASSERT_NE(b.fits, nullptr);
  EXPECT_EQ(run(a, x, {0.3f, 2.0f}), run(b, x, {0.3f, 2.0f}));
}

/// Points of which a fact is not true are computed by a kernel of their own, from the same fits.
TEST_F(FitParameters, FactsChangeNoBit) {
  const std::vector<float> x = cosines();
  const std::vector<float> without = run(make(metal()), x, {0.3f, 2.0f});
  options_.facts = {{"x", 0.3, 0.6}};
  EXPECT_EQ(run(make(metal()), x, {0.3f, 2.0f}), without);
}

TEST_F(FitParameters, InterpretedUntilTheCodeIsThereBitsAreTheSame) {
  const std::vector<float> x = cosines();
  options_.asynchronous = true;
  const Made made = make(metal());
  const std::vector<float> first = run(made, x, {0.3f, 2.0f});
  EXPECT_TRUE(dynamic_cast<const CompiledKernel&>(*made.kernel).wait());
  EXPECT_EQ(run(made, x, {0.3f, 2.0f}), first);
  EXPECT_FALSE(first.empty());
}

/// A number that is far from 0 has too few digits to have a place between two that are near.
TEST_F(FitParameters, NumbersFarFromZeroAreNoKeys) {
  const auto made_of = [&](float low) {
    Recorder recorder;
    const Float x = clamp(Float(recorder.input("x", Scalar::f32)), low, low + 1.0f);
    const Float k(recorder.parameter("k", Scalar::f32, 0));
    const Float value = sin(k * x) + cos(k * x) + exp(-k * x) + exp2(k * x);
    return make(slice(recorder.program(), "test", std::vector<SliceOutput>{{"y", value.ref()}}));
  };
  EXPECT_NE(made_of(2.0f).fits, nullptr);
  EXPECT_EQ(made_of(1e5f).fits, nullptr);
}

TEST_F(FitParameters, RangesNeedNotBeginAtZero) {
  Recorder recorder;
  const Float x = clamp(Float(recorder.input("x", Scalar::f32)), -0.5f, 0.5f);
  const Float k(recorder.parameter("k", Scalar::f32, 0));
  const Float value = sin(k * x) + cos(k * x) + exp(-k * x) + exp2(k * x);
  const Made made =
      make(slice(recorder.program(), "test", std::vector<SliceOutput>{{"y", value.ref()}}));
  ASSERT_NE(made.fits, nullptr);
  std::vector<float> numbers;
  for (int i = -25; i <= 25; ++i) numbers.push_back(0.03f * static_cast<float>(i));
  const std::vector<float> y = run(made, numbers, {0.8f});
  ASSERT_EQ(made.fits->of(bits_of({0.8f}))->data()[0], 1.0f);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double at = 0.8 * std::clamp(double{numbers[i]}, -0.5, 0.5);
    const double exact = std::sin(at) + std::cos(at) + std::exp(-at) + std::exp2(at);
    EXPECT_NEAR(y[i], exact, 5e-5 * exact) << numbers[i];
  }
}

/// A lock that another thread holds at a fork is held for ever in the child.
TEST_F(FitParameters, ChildrenOfForkWaitForNoLock) {
  const Made made = make(metal());
  const std::vector<float> x = cosines();
  const std::vector<float> expected = run(made, x, {0.3f, 2.0f});
  LastFitted last;
  std::atomic<bool> is_over = false;
  std::vector<std::thread> threads;
  for (int i = 0; i < 2; ++i) {
    threads.emplace_back([&] {
      while (!is_over) {
        for (const float n : {0.2f, 0.2f, 0.2f, 0.7f})
          (void)made.fits->of(bits_of({n, 2.0f}), &last);
      }
    });
  }
  int wrong = 0;
  for (int i = 0; i < 60; ++i) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      alarm(20);
      const auto bits = bits_of({0.3f, 2.0f});
      const auto fitted = made.fits->of(bits, &last);
      _exit(run(*made.kernel, x, bits, fitted->data()) == expected ? 0 : 1);
    }
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    wrong += status != 0 ? 1 : 0;
  }
  is_over = true;
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0);
}

TEST_F(FitParameters, FitsAreBytes) {
  options_.backend = Backend::interpreter;
  const Made made = make(metal());
  const Program& program = made.kernel->program();
  ASSERT_FALSE(program.fits.empty());
  const auto again = program_from_bytes(to_bytes(program));
  ASSERT_TRUE(again);
  EXPECT_EQ(to_bytes(*again), to_bytes(program));
  Program broken = program;
  broken.fits.front().row = program.fitted_rows;
  EXPECT_FALSE(program_from_bytes(to_bytes(broken)));
}

}  // namespace
}  // namespace nacre
