// What is worth a branch: regions that cost less than a test are made straight, others stay,
// and no bit of a result changes.

#include "jit/passes/flatten.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "runtime/interpreter/interpreter.h"
#include "runtime/program/slice.h"
#include "runtime/value/control.h"
#include "tests/support/random_program.h"

namespace nacre {
namespace {

std::size_t regions(const Program& program) {
  std::size_t count = 0;
  for (const Function& function : program.functions) {
    for (const Instruction& instruction : function.code) {
      count += instruction.op == Op::if_any ? 1u : 0u;
    }
  }
  return count;
}

Program sliced(const Recorder& recorder, Float value) {
  const std::vector<SliceOutput> outputs{{"out", value.ref()}};
  return slice(recorder.program(), "test", outputs);
}

/// x + 1, so many times, with roundings that nothing folds.
Float longer(Float x, int additions) {
  for (int i = 0; i < additions; ++i) x = x + Float(1.0f + 0.25f * static_cast<float>(i));
  return x;
}

Program with_region(int additions) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  return sliced(recorder, if_any(x > 0.0f, x, [&] { return longer(x, additions); }));
}

TEST(Flatten, ShortRegionsBecomeSelects) {
  const Program before = with_region(3);
  EXPECT_EQ(regions(before), 1u);
  const Program after = flatten_regions(before);
  EXPECT_EQ(regions(after), 0u) << to_string(after);
  EXPECT_NE(to_string(after).find("select"), std::string::npos) << to_string(after);
}

TEST(Flatten, LongRegionsStay) { EXPECT_EQ(regions(flatten_regions(with_region(60))), 1u); }

TEST(Flatten, RegionsInRegionsAreLookedAtEach) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const Float value = if_any(x > 0.0f, x, [&] {
    const Float inner = if_any(x > 1.0f, x, [&] { return x * 3.0f; });
    return longer(inner, 60);
  });
  const Program before = sliced(recorder, value);
  EXPECT_EQ(regions(before), 2u);
  EXPECT_EQ(regions(flatten_regions(before)), 1u);
}

/// A call costs what is called.
TEST(Flatten, CallsCountWithTheirBodies) {
  for (const int additions : {3, 60}) {
    Recorder recorder;
    const Float x(recorder.input("x", Scalar::f32));
    const Float value = if_any(x > 0.0f, x, [&] {
      return outline<Float>(recorder, "longer", [&](Float y) { return longer(y, additions); }, x);
    });
    EXPECT_EQ(regions(flatten_regions(sliced(recorder, value))), additions == 3 ? 0u : 1u);
  }
}

TEST(Flatten, LoopsAreNeverForAllLanes) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const Float value = if_any(x > 0.0f, x, [&] {
    return loop(recorder, true, 2, x, [&](Int, Float& y) {
      y = y * 1.5f;
      return y < 8.0f;
    });
  });
  EXPECT_EQ(regions(flatten_regions(sliced(recorder, value))), 1u);
}

TEST(Flatten, NoBitChanges) {
  std::vector<std::uint32_t> order(67);
  std::iota(order.begin(), order.end(), 0u);
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const Program before = random_program(seed, {.operations = 80});
    Program after = flatten_regions(before);
    ASSERT_EQ(verify(after), "") << seed;
    ASSERT_LE(regions(after), regions(before)) << seed;
    mark_varying(after);
    const RandomBatch batch(before, seed, order);
    EXPECT_EQ(batch.run(*make_interpreter(before), 0, order.size()),
              batch.run(*make_interpreter(after), 0, order.size()))
        << "seed " << seed;
  }
}

}  // namespace
}  // namespace nacre
