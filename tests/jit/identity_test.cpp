// The bits of compiled code are those of the interpreter: over random Programs,
// every width, batch size and position in a batch.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <string>
#include <thread>

#include "runtime/interpreter/interpreter.h"
#include "runtime/program/slice.h"
#include "tests/jit/engine.h"
#include "tests/support/random.h"
#include "tests/support/random_program.h"

namespace nacre {
namespace {

constexpr std::uint32_t points = 67;

std::uint64_t first_seed() {
  const char* text = std::getenv("NACRE_TEST_SEED");
  return text == nullptr ? 20240611 : std::strtoull(text, nullptr, 10);
}

bool full_run() { return std::getenv("NACRE_TEST_FULL") != nullptr; }

std::vector<std::uint32_t> in_order() {
  std::vector<std::uint32_t> order(points);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

/// Why a kernel's output for points start ... is not `expected`; or "".
std::string difference(const std::vector<std::vector<std::uint32_t>>& expected,
                       const std::vector<std::vector<std::uint32_t>>& found, std::size_t start,
                       const std::vector<std::uint32_t>& order) {
  if (found.size() != expected.size()) return "wrote beyond its points";
  for (std::size_t o = 0; o < found.size(); ++o) {
    for (std::size_t k = 0; k < found[o].size(); ++k) {
      const std::uint32_t wanted = expected[o][order[start + k]];
      if (found[o][k] == wanted) continue;
      char text[160];
      std::snprintf(text, sizeof text,
                    "output %zu point %zu of %zu (from %zu): %08x, expected %08x", o, k,
                    found[o].size(), start, found[o][k], wanted);
      return text;
    }
  }
  return {};
}

/// Runs the kernel over all points, over a part of them, and shuffled with
/// duplicates.
std::string compare(const Program& program, std::uint64_t seed, const CodegenOptions& options) {
  const std::vector<std::uint32_t> order = in_order();
  const RandomBatch batch(program, seed, order);
  const auto expected = batch.run(*make_interpreter(program), 0, points);
  const auto kernel = compiled(program, options);
  if (kernel == nullptr) return "did not compile";
  Random random(seed ^ 0x5555);
  const std::uint32_t count = 1 + random.below(3 * static_cast<std::uint32_t>(options.lanes) + 1);
  const std::uint32_t start = random.below(points - count + 1);
  std::string fault = difference(expected, batch.run(*kernel, 0, points), 0, order);
  if (fault.empty()) fault = difference(expected, batch.run(*kernel, start, count), start, order);
  if (!fault.empty() || random.below(4) != 0) return fault;
  std::vector<std::uint32_t> shuffled;
  for (std::uint32_t k = 0; k < points; ++k) shuffled.push_back(random.below(points));
  const RandomBatch other(program, seed, shuffled);
  return difference(expected, other.run(*kernel, 0, points), 0, shuffled);
}

/// The first value of a failing Program that is wrong by itself.
std::string explain(const Program& program, std::uint64_t seed, const CodegenOptions& options) {
  for (const ValueId value : top_level_values(program)) {
    const Program part = program_of_value(program, value);
    const std::string fault = compare(part, seed, options);
    if (!fault.empty()) return fault + "\n" + to_string(part);
  }
  return to_string(program);
}

void expect_identity(std::uint64_t first, std::uint64_t count, const CodegenOptions& options,
                     const RandomProgramOptions& shape = {}) {
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Program program = random_program(seed, shape);
    ASSERT_EQ(verify(program), "") << "seed " << seed;
    const std::string fault = compare(program, seed, options);
    ASSERT_EQ(fault, "") << "seed " << seed << ", W = " << options.lanes << "\n"
                         << explain(program, seed, options);
  }
}

/// W and tier, for tests that differ in nothing else.
class Identity : public testing::TestWithParam<std::tuple<int, Tier>> {
 protected:
  static CodegenOptions options() {
    CodegenOptions made;
    made.lanes = std::get<0>(GetParam());
    made.tier = std::get<1>(GetParam());
    return made;
  }
};

TEST_P(Identity, OfRandomPrograms) {
  const std::uint64_t count = full_run() ? 20000 : 2000;
  RecordProperty("seed", std::to_string(first_seed()));
  expect_identity(first_seed(), count, options());
}

INSTANTIATE_TEST_SUITE_P(Widths, Identity,
                         testing::Combine(testing::Values(1, 4, 8, 16),
                                          testing::Values(Tier::quick, Tier::full)),
                         [](const auto& each) {
                           return "W" + std::to_string(std::get<0>(each.param)) +
                                  (std::get<1>(each.param) == Tier::full ? "Full" : "Quick");
                         });

}  // namespace
}  // namespace nacre
