#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "jit/passes/range.h"
#include "runtime/interpreter/interpreter.h"
#include "tests/support/random.h"

namespace nacre {

/// A Program's inputs: floats within what is said of each, integers of any bits.
struct Within {
  static constexpr std::size_t points = 64;

  Within(const Program& program, Random& random) : numbers(program.inputs.size()) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const bool is_float = program.inputs[i].type == Scalar::f32;
      const auto a = static_cast<float>(random.below(400)) / 100.0f - 2.0f;
      const auto width = static_cast<float>(random.below(5)) * 0.3f;
      for (std::size_t k = 0; k < points; ++k) {
        const float share = static_cast<float>(random.below(65)) / 64.0f;
        numbers[i].push_back(is_float ? std::bit_cast<std::uint32_t>(a + share * width)
                                      : static_cast<std::uint32_t>(random.word()));
      }
      const float last = a + width;
      ranges.push_back(is_float ? Range{a, last, false} : Range{});
    }
    for (std::size_t i = 0; i < program.parameters.size(); ++i) {
      parameters.push_back(static_cast<std::uint32_t>(random.word()));
    }
  }

  std::vector<std::uint32_t> run(const Program& program) const {
    std::vector<std::uint32_t> result(points);
    std::vector<const void*> inputs;
    for (const auto& each : numbers) inputs.push_back(each.data());
    void* outputs[]{result.data()};
    EXPECT_EQ(make_interpreter(program)->run({.inputs = inputs.data(),
                                              .outputs = outputs,
                                              .parameters = parameters.data(),
                                              .count = points}),
              RunStatus::done);
    return result;
  }

  std::vector<std::vector<std::uint32_t>> numbers;
  std::vector<Range> ranges;
  std::vector<std::uint32_t> parameters;
};

}  // namespace nacre
