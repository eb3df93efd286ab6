#include "tests/support/enclosure.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "runtime/interpreter/interpreter.h"
#include "runtime/reference/reference.h"
#include "tests/support/random_program.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

using testing::enclose;
using testing::Enclosure;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// What a body of x and y is enclosed in.
template <class F>
Enclosure of(float x, float y, F&& body, testing::FloatRange range = {}) {
  Recorder recorder;
  const Float a = input(recorder, "x");
  const Float b = input(recorder, "y");
  const std::vector<SliceOutput> outputs{{"z", body(a, b).ref()}};
  const Program program = slice(recorder.program(), "test", outputs);
  std::vector<std::uint32_t> inputs;
  for (const Channel& channel : program.inputs) {
    inputs.push_back(std::bit_cast<std::uint32_t>(channel.name == "x" ? x : y));
  }
  return enclose(program, inputs, {}, range).front();
}

TEST(Enclosure, IsExactWhereTheFloatsAre) {
  const Enclosure sum = of(1.5f, 0.25f, [](Float x, Float y) { return x + y; });
  EXPECT_TRUE(sum.is_exact());
  EXPECT_EQ(sum.lo, 1.75);
}

/// 1 + 1e-7 is half an ulp and more from both neighbours: an ulp of 1 stays after 1 is gone.
TEST(Enclosure, KeepsTheErrorThatCancellationLaysBare) {
  const Enclosure rest = of(1.0f, 1e-7f, [](Float x, Float y) { return (x + y) - x; });
  EXPECT_TRUE(rest.contains(0x1p-23));  // In float.
  EXPECT_TRUE(rest.contains(static_cast<double>(1e-7f)));
  EXPECT_LT(rest.hi - rest.lo, 0x1.1p-23);
  EXPECT_FALSE(rest.is_narrow());
}

TEST(Enclosure, OverflowIsBothANumberAndInfinite) {
  const auto body = [](Float x, Float y) { return x * x * y; };
  const Enclosure both = of(1e30f, 1e-30f, body);
  EXPECT_TRUE(both.contains(1e30));
  EXPECT_TRUE(both.contains(infinity));
  EXPECT_FALSE(both.contains(-infinity));
  EXPECT_FALSE(of(1e30f, 1e-30f, body, {.overflows = false}).contains(infinity));
}

TEST(Enclosure, AComparisonThatMayFallEitherWayCountsBoth) {
  const auto body = [](Float x, Float y) { return select(x * y < 0.01f, Float(1.0f), 2.0f); };
  const Enclosure open = of(0.1f, 0.1f, body);
  EXPECT_EQ(open.lo, 1.0);
  EXPECT_EQ(open.hi, 2.0);
  EXPECT_TRUE(of(0.1f, 0.2f, body).is_exact());
}

/// The interpreter's floats and the reference engine's doubles, rounded to float, of any
/// Program at any input.
TEST(Enclosure, HasWhatTheEnginesGive) {
  int narrow = 0;
  int results = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const Program program = random_program(seed, {.memory = false});
    std::vector<std::uint32_t> inputs;
    std::vector<std::uint32_t> parameters;
    std::vector<const void*> in;
    for (const Channel& channel : program.inputs) {
      const std::uint32_t bits = hostile_bits(seed * 1000 + inputs.size());
      inputs.push_back(channel.type == Scalar::b1 ? bits & 1 : bits);
    }
    for (const std::uint32_t& bits : inputs) in.push_back(&bits);
    for (std::size_t i = 0; i < program.parameters.size(); ++i) {
      parameters.push_back(hostile_bits(seed * 1000 + 500 + i));
    }
    const std::vector<Enclosure> enclosures = enclose(program, inputs, parameters);
    for (const bool in_double : {false, true}) {
      std::vector<std::uint32_t> outputs(program.outputs.size());
      std::vector<void*> out;
      for (std::uint32_t& bits : outputs) out.push_back(&bits);
      const KernelArguments arguments{
          .inputs = in.data(), .outputs = out.data(), .parameters = parameters.data(), .count = 1};
      in_double ? make_reference(program)->run(arguments)
                : make_interpreter(program)->run(arguments);
      for (std::size_t k = 0; k < outputs.size(); ++k) {
        const bool is_float = program.outputs[k].type == Scalar::f32;
        const double x =
            is_float ? static_cast<double>(std::bit_cast<float>(outputs[k])) : outputs[k];
        EXPECT_TRUE(enclosures[k].contains(x))
            << "seed " << seed << " output " << k << ": " << x << " not in [" << enclosures[k].lo
            << ", " << enclosures[k].hi << ']';
        narrow += enclosures[k].is_narrow();
        ++results;
      }
    }
  }
  EXPECT_GT(narrow * 2, results);
}

}  // namespace
}  // namespace nacre
