#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "runtime/program/slice.h"
#include "runtime/value/value.h"
#include "tests/jit/llvm/engine.h"
#include "tests/support/run_kernel.h"

namespace nacre {
namespace {

/// Either side negated: the JIT has code of its own for it.
Program flipped_signs() {
  Recorder recorder;
  const Float x = input(recorder, "x");
  const Bool choose = input(recorder, "choose") > 0.5f;
  const std::vector<SliceOutput> outputs{{"first", select(choose, -x, x).ref()},
                                         {"second", select(choose, x, -x).ref()}};
  return slice(recorder.program(), "flipped", outputs);
}

TEST(Select, FlipsTheSignWhereItShould) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  Columns in;
  for (const float x : {0.0f, -0.0f, 1.5f, -1.5f, inf, -inf, 3.4e38f, -1.2e-38f}) {
    for (const float choose : {0.0f, 1.0f, 1.0f}) {
      in["x"].push_back(x);
      in["choose"].push_back(choose);
    }
  }
  const Program program = flipped_signs();
  for (const int lanes : {1, 4, 8, 16}) {
    // With the mask registers that this machine may have, and without.
    for (const Target& target : {Target::host(), Target::named("x86-64")}) {
      const CodegenOptions options{.lanes = lanes, .target = target};
      const auto kernel = compiled(program, options);
      ASSERT_NE(kernel, nullptr);
      const Columns out = run(*kernel, in);
      for (std::size_t i = 0; i < in["x"].size(); ++i) {
        const auto bits = std::bit_cast<std::uint32_t>(in["x"][i]);
        const std::uint32_t flip = in["choose"][i] > 0.5f ? 0x80000000u : 0u;
        EXPECT_EQ(std::bit_cast<std::uint32_t>(out.at("first")[i]), bits ^ flip);
        EXPECT_EQ(std::bit_cast<std::uint32_t>(out.at("second")[i]), bits ^ flip ^ 0x80000000u);
      }
    }
  }
}

}  // namespace
}  // namespace nacre
