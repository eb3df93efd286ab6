#include "runtime/program/once.h"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "runtime/program/slice.h"
#include "runtime/value/control.h"

namespace nacre {
namespace {

/// The operations of a kind that are computed once a call, and all of them.
std::pair<int, int> counted(const Program& program, Op op, bool out_of_regions = false) {
  const std::vector<bool> once =
      out_of_regions ? once_out_of_regions(program.entry()) : once_per_call(program.entry());
  std::pair<int, int> count;
  for (std::size_t i = 0; i < once.size(); ++i) {
    if (program.entry().code[i].op != op) continue;
    count.first += once[i] ? 1 : 0;
    ++count.second;
  }
  return count;
}

TEST(Once, UniformRegionsAreComputedOnce) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const Float p(recorder.parameter("p", Scalar::f32, std::bit_cast<std::uint32_t>(2.0f)));
  const Float uniform = if_any(p > 1.0f, p, [&] { return sqrt(p); });
  const Float varying = if_any(x > 1.0f, x, [&] { return sqrt(x); });
  const std::vector<SliceOutput> outputs{{"out", (uniform + varying).ref()}};
  const Program program = slice(recorder.program(), "test", outputs);
  EXPECT_EQ(counted(program, Op::sqrt), std::pair(1, 2)) << to_string(program);
  EXPECT_EQ(counted(program, Op::if_any), std::pair(1, 2));
  EXPECT_EQ(counted(program, Op::store), std::pair(0, 1));
}

/// Uniform, but what its region needs is not.
TEST(Once, RegionsThatNeedAPointAreNot) {
  Recorder recorder;
  const Float x(recorder.input("x", Scalar::f32));
  const Float p(recorder.parameter("p", Scalar::f32, std::bit_cast<std::uint32_t>(2.0f)));
  const Float2 both = if_any(x > 1.0f, Float2{p, x}, [&] { return Float2{sqrt(p), x * p}; });
  const std::vector<SliceOutput> outputs{{"out", (both.x + both.y).ref()}};
  const Program program = slice(recorder.program(), "test", outputs);
  EXPECT_EQ(counted(program, Op::if_any).first, 0);
  EXPECT_EQ(counted(program, Op::sqrt).first, 0);
  // But what they compute of parameters alone can be known before.
  EXPECT_EQ(counted(program, Op::sqrt, true), std::pair(1, 1));
  EXPECT_EQ(counted(program, Op::mul, true), std::pair(0, 1));
  EXPECT_EQ(counted(program, Op::merge, true).first, 0);
}

}  // namespace
}  // namespace nacre
