// What a host says of numbers leaves out what cannot happen, and is found out where it is not so.

#include "jit/compile/facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "jit/compile/compile.h"
#include "jit/compile/fact_kernel.h"
#include "runtime/value/control.h"
#include "runtime/value/vector.h"
#include "tests/support/run_kernel.h"
#include "tests/support/temporary_folder.h"

namespace nacre {
namespace {

/// Numbers that a fact is about: x where it is small, and by how much it is not.
Program program() {
  Recorder recorder;
  const Float x = input(recorder, "uv.x"), y = input(recorder, "uv.y");
  const Float weight(recorder.parameter("coat", Scalar::f32, std::bit_cast<std::uint32_t>(0.5f)));
  // So much that it pays to look whether a fact is so.
  Float clamped = min(max(x, 0.0f), 1.0f);
  for (int i = 0; i < 4; ++i) clamped = min(max(clamped * x, 0.0f), 1.0f);
  const Float coat = if_any(weight > 0.0f, Float(0.0f), [&] { return sqrt(y * y + weight) / x; });
  return slice(recorder.program(), "test",
               std::vector<SliceOutput>{{"clamped", (clamped * y).ref()}, {"coat", coat.ref()}});
}

class Facts : public testing::Test {
 protected:
  Facts() {
    options_.whole = true;     // Stages are looked at.
    options_.table_error = 0;  // Else there is nothing left to leave out.
    open("");
  }
  void open(const std::string& cache) {
    service_ = CompileService::create({.cache = cache, .session = {}}, diagnostics_);
  }

  std::shared_ptr<const Kernel> make(std::vector<Fact> facts) {
    CompileOptions options = options_;
    options.facts = std::move(facts);
    stages_.clear();
    return compile(program(), options, service_.get(), diagnostics_, &stages_);
  }

  /// How many instructions it was made of.
  std::size_t size() const { return stages_.back().instructions; }

  /// The same as of a kernel that was told nothing; the points that this one was needed for.
  std::uint64_t outside(const Kernel& kernel, const Columns& inputs) {
    const auto general = make({});
    const Columns expected = run(*general, inputs);
    const Columns found = run(kernel, inputs);
    for (const auto& [name, column] : expected) {
      EXPECT_TRUE(std::ranges::equal(found.at(name), column, [](float a, float b) {
        return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
      })) << name;
    }
    EXPECT_EQ(found.size(), expected.size());
    const auto* checked = dynamic_cast<const FactKernel*>(&kernel);
    return checked != nullptr ? checked->points_outside() : 0;
  }

  CompileOptions options_;
  std::shared_ptr<CompileService> service_;
  Diagnostics diagnostics_;
  std::vector<StageReport> stages_;
};

const Fact unit{.name = "uv", .low = 0, .high = 1};
const Fact no_coat{.name = "coat", .low = 0, .high = 0};

std::vector<float> ramp(std::size_t count) {
  std::vector<float> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back(static_cast<float>(i + 1) / static_cast<float>(count + 1));
  }
  return numbers;
}

TEST_F(Facts, LeaveOutWhatCannotHappen) {
  const auto kernel = make({unit});
  ASSERT_NE(kernel, nullptr);
  const auto decided = std::ranges::find(stages_, "decide", &StageReport::name);
  ASSERT_NE(decided, stages_.end());
  ASSERT_EQ(decided->facts.size(), 1u);
  EXPECT_EQ(decided->facts[0].fact.name, "uv.x");
  EXPECT_TRUE(is_part_of(decided->facts[0].fact, unit));
  EXPECT_GE(decided->facts[0].saved, 6u);  // min and max.
  EXPECT_EQ(outside(*kernel, {{"uv.x", ramp(5000)}, {"uv.y", ramp(5000)}}), 0u);
}

// -0 + 0 is 0, also of a 0 that has become a literal, and where something is checked after that.
TEST_F(Facts, KeepTheSignsOfZeros) {
  Recorder recorder;
  const Float y = input(recorder, "uv.y");
  const Float none(recorder.parameter("none", Scalar::f32, 0));
  Float clamped = y;
  for (int i = 0; i < 5; ++i) clamped = min(max(clamped * y, 0.0f), 1.0f);
  const Program sums = slice(recorder.program(), "test",
                             std::vector<SliceOutput>{{"sum", (none + y).ref()},
                                                      {"product", fma(y, y, none * y).ref()},
                                                      {"clamped", clamped.ref()}});
  options_.backend = Backend::interpreter;
  const auto general = compile(sums, options_, service_.get(), diagnostics_, &stages_);
  // -0 is outside of what starts at 0.
  options_.facts = {{"none", 0, 0}, {"uv.y", -1e-30f, 1}};
  stages_.clear();
  const auto kernel = compile(sums, options_, service_.get(), diagnostics_, &stages_);
  ASSERT_NE(std::ranges::find(stages_, "check", &StageReport::name), stages_.end());
  const Columns zeros{{"uv.y", {-0.0f, 0.0f}}};
  const Columns found = run(*kernel, zeros);
  EXPECT_EQ(dynamic_cast<const FactKernel&>(*kernel).points_outside(), 0u);
  for (const auto& [name, column] : run(*general, zeros)) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      EXPECT_EQ(std::signbit(found.at(name)[i]), std::signbit(column[i])) << name << i;
    }
  }
  EXPECT_FALSE(std::signbit(found.at("sum")[0]));
}

// What is computed takes them for zeros, so what is known must too: of a number that is said to be
// 2^-130 at least, and is 0, more than that would be concluded.
TEST_F(Facts, TakeDenormalsForZeros) {
  Recorder recorder;
  const Float least(recorder.parameter("least", Scalar::f32, 0));
  const Float x = input(recorder, "v.x"), y = input(recorder, "v.y"), z = input(recorder, "v.z");
  const Program signs = slice(
      recorder.program(), "test",
      std::vector<SliceOutput>{
          {"sign", select(least > 0.0f, Float(1.0f), Float(0.0f)).ref()},
          {"same", select(least > 0.0f, least / least, Float(0.0f)).ref()},
          {"large", select((abs(x) + abs(y) + abs(z)) * 1e20f < 0.5f, x, Float(7.0f)).ref()}});
  options_.backend = Backend::interpreter;
  const auto general = compile(signs, options_, service_.get(), diagnostics_, &stages_);
  const Columns points{{"v.x", {1e-20f, 0.0f}}, {"v.y", {0.0f}}, {"v.z", {0.0f}}};
  const Columns expected = run(*general, points);
  for (const double low : {0x1p-149, 0x1p-130, 0x1p-126}) {
    options_.facts = {{"least", low, 1}, {"dot(v,v)", 0, 0}};
    const auto kernel = compile(signs, options_, service_.get(), diagnostics_, &stages_);
    EXPECT_EQ(run(*kernel, points), expected) << low;
  }
}

TEST_F(Facts, OfNothingThatIsReadChangeNothing) {
  const auto plain = make({});
  const std::size_t size = this->size();
  const auto kernel = make({{"P", -1, 1}, {"uvw", 0, 1}, {"u", 0, 1}, {"dot(N,wo)", 0, 1}});
  EXPECT_EQ(this->size(), size);
  EXPECT_EQ(dynamic_cast<const FactKernel*>(kernel.get()), nullptr);
}

// One that says nothing new is not even looked at.
TEST_F(Facts, WithoutUseAreNotChecked) {
  const auto kernel = make({{"uv.y", 0, 1}});
  std::vector<float> y = ramp(100);
  y[7] = 30;
  EXPECT_EQ(outside(*kernel, {{"uv.x", ramp(100)}, {"uv.y", y}}), 0u);
}

TEST_F(Facts, ThatAreBrokenAreFoundOut) {
  for (const Backend backend : {Backend::jit, Backend::interpreter}) {
    options_.backend = backend;
    for (const float wrong :
         {1.0001f, -1e-20f, -0.0f, 3e38f, std::nanf(""), std::numeric_limits<float>::infinity()}) {
      // In a block, and in the last points, fewer than a pass.
      for (const std::size_t place : {3000u, 5002u}) {
        const auto kernel = make({unit});
        ASSERT_NE(kernel, nullptr);
        std::vector<float> x = ramp(5003);
        EXPECT_EQ(outside(*kernel, {{"uv.x", x}, {"uv.y", ramp(5003)}}), 0u);
        x[place] = wrong;
        const std::uint64_t points = outside(*kernel, {{"uv.x", x}, {"uv.y", ramp(5003)}});
        EXPECT_GT(points, 0u) << wrong;
        EXPECT_LE(points, 16u) << wrong;
      }
    }
  }
}

TEST_F(Facts, ThatAreBrokenInManyPlacesAreFoundOutThere) {
  const auto kernel = make({unit});
  std::vector<float> x = ramp(5003);
  // A group, two side by side, and the last of a block with the first of the next.
  for (const std::size_t place : {100u, 1000u, 1010u, 2047u, 2048u}) x[place] = 7;
  EXPECT_EQ(outside(*kernel, {{"uv.x", x}, {"uv.y", ramp(5003)}}), 5u * 16u);
}

TEST_F(Facts, OfParametersHoldForEachCall) {
  const auto kernel = make({no_coat});
  const Program& bound = kernel->program();
  ASSERT_EQ(bound.parameters.size(), 1u);
  ASSERT_EQ(bound.outputs.size(), 2u);
  const float x = 0.5f, y = 0.25f;
  const std::vector<const void*> inputs = bound.inputs[0].name == "uv.x"
                                              ? std::vector<const void*>{&x, &y}
                                              : std::vector<const void*>{&y, &x};
  const auto coat = [&](float weight) {
    float clamped = -1, result = -1;
    void* outputs[]{&clamped, &result};
    const auto bits = std::bit_cast<std::uint32_t>(weight);
    const RunStatus status =
        kernel->run({.inputs = inputs.data(), .outputs = outputs, .parameters = &bits, .count = 1});
    EXPECT_EQ(status, RunStatus::done);
    EXPECT_EQ(clamped, 0.0078125f);
    return result;
  };
  EXPECT_EQ(coat(0.0f), 0.0f);
  EXPECT_EQ(dynamic_cast<const FactKernel&>(*kernel).points_outside(), 0u);
  EXPECT_FLOAT_EQ(coat(0.5f), std::sqrt(0.0625f + 0.5f) / 0.5f);
  EXPECT_EQ(dynamic_cast<const FactKernel&>(*kernel).points_outside(), 1u);
  EXPECT_EQ(coat(0.0f), 0.0f);
  EXPECT_EQ(dynamic_cast<const FactKernel&>(*kernel).points_outside(), 1u);
}

TEST_F(Facts, OfTheDocumentsOwnValueAreBrokenFromTheStart) {
  const auto kernel = make({no_coat});  // It is .5 there.
  EXPECT_EQ(outside(*kernel, {{"uv.x", ramp(50)}, {"uv.y", ramp(50)}}), 50u);
}

TEST_F(Facts, ArePartOfWhatCodeIsKnownBy) {
  const TemporaryFolder folder;
  open(folder.path().string());
  make({});
  make({unit});
  make({no_coat});
  // From the cache now, by another system.
  open(folder.path().string());
  options_.whole = false;
  const auto kernel = make({unit});
  EXPECT_EQ(std::ranges::find(stages_, "decide", &StageReport::name), stages_.end());
  std::vector<float> x = ramp(400);
  EXPECT_EQ(outside(*kernel, {{"uv.x", x}, {"uv.y", ramp(400)}}), 0u);
  x[200] = 2;
  EXPECT_EQ(outside(*kernel, {{"uv.x", x}, {"uv.y", ramp(400)}}), 16u);
}

TEST_F(Facts, OfKernelsThatOutliveTheirSystemToo) {
  const auto kernel = make({unit});
  std::vector<float> x = ramp(100);
  x[50] = -3;
  const auto general = make({});
  service_.reset();
  const Columns inputs{{"uv.x", x}, {"uv.y", ramp(100)}};
  EXPECT_EQ(run(*kernel, inputs), run(*general, inputs));
}

TEST_F(Facts, ManyThreadsMayBreakAtOnce) {
  const auto kernel = make({unit});
  std::vector<float> x = ramp(3000);
  x[50] = -3;
  const Columns inputs{{"uv.x", x}, {"uv.y", ramp(3000)}};
  const Columns expected = run(*make({}), inputs);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 20; ++k) EXPECT_EQ(run(*kernel, inputs), expected);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST_F(Facts, CodeThatIsCalledDirectlyIsGeneral) {
  const auto kernel = make({unit});
  auto& made = const_cast<FactKernel&>(dynamic_cast<const FactKernel&>(*kernel));
  const auto code = made.code(false);
  ASSERT_TRUE(code.has_value());
  const auto plain = make({});
  const auto& general = dynamic_cast<const CompiledKernel&>(*plain);
  EXPECT_EQ(code->entry, general.code(false)->entry);
}

TEST(FactTexts, ThatSayNothingAreErrors) {
  const auto fault = [](const Fact& fact) {
    Diagnostics diagnostics;
    const bool is_right = check_facts(std::vector{fact}, diagnostics);
    EXPECT_EQ(is_right, diagnostics.error_count() == 0);
    return !is_right;
  };
  EXPECT_FALSE(fault(unit));
  EXPECT_FALSE(fault({"dot(N,wo)", 0, 1}));
  EXPECT_TRUE(fault({"uv", 1, 0}));
  EXPECT_TRUE(fault({"uv", 0, std::nan("")}));
  EXPECT_TRUE(fault({"uv", 0, std::numeric_limits<double>::infinity()}));
  EXPECT_TRUE(fault({"", 0, 1}));
  EXPECT_TRUE(fault({"dot(N)", 0, 1}));
  EXPECT_TRUE(fault({"dot(N,wo", 0, 1}));
  EXPECT_TRUE(fault({"length(N)", 0, 1}));
  // No float is in it.
  EXPECT_TRUE(fault({"uv", 0.1, 0.1}));
}

TEST(FactTexts, NameWhatIsRead) {
  const Program program = nacre::program();
  const auto names = [&](const std::string& name) {
    return facts_of(std::vector<Fact>{{name, 0, 1}}, program).size();
  };
  EXPECT_EQ(names("uv"), 2u);
  EXPECT_EQ(names("uv.y"), 1u);
  EXPECT_EQ(names("coat"), 1u);
  EXPECT_EQ(names("u"), 0u);
  EXPECT_EQ(names("uv.z"), 0u);
  EXPECT_EQ(names("dot(uv,uv)"), 0u);
}

}  // namespace
}  // namespace nacre
