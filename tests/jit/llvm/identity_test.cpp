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
#include "tests/jit/llvm/engine.h"
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

/// A batch and what the interpreter makes of it.
struct Case {
  Case(const Program& from, std::uint64_t with_seed)
      : program(from),
        seed(with_seed),
        batch(program, seed, in_order()),
        expected(batch.run(*make_interpreter(program), 0, points)) {}

  const Program& program;
  std::uint64_t seed;
  RandomBatch batch;
  std::vector<std::vector<std::uint32_t>> expected;
};

/// Runs a kernel over all points, over a part of them, and shuffled with
/// duplicates.
std::string compare(const Case& one, const CodegenOptions& options) {
  const auto kernel = compiled(one.program, options);
  if (kernel == nullptr) return "did not compile";
  const std::vector<std::uint32_t> order = in_order();
  Random random(one.seed ^ 0x5555);
  const std::uint32_t count = 1 + random.below(3 * static_cast<std::uint32_t>(options.lanes) + 1);
  const std::uint32_t start = random.below(points - count + 1);
  const auto check = [&](const RandomBatch& batch, std::size_t from, std::size_t number,
                         const std::vector<std::uint32_t>& which) {
    return difference(one.expected, batch.run(*kernel, from, number), from, which);
  };
  std::string fault = check(one.batch, 0, points, order);
  if (fault.empty()) fault = check(one.batch, start, count, order);
  if (!fault.empty() || random.below(4) != 0) return fault;
  std::vector<std::uint32_t> shuffled;
  for (std::uint32_t k = 0; k < points; ++k) shuffled.push_back(random.below(points));
  return check(RandomBatch(one.program, one.seed, shuffled), 0, points, shuffled);
}

/// The first value of a failing Program that is wrong by itself.
std::string explain(const Case& one, const CodegenOptions& options) {
  for (const ValueId value : top_level_values(one.program)) {
    const Program part = program_of_value(one.program, value);
    const std::string fault = compare(Case(part, one.seed), options);
    if (!fault.empty()) return fault + "\n" + to_string(part);
  }
  return to_string(one.program);
}

void expect_identity(const Case& one, const CodegenOptions& options) {
  const std::string fault = compare(one, options);
  ASSERT_EQ(fault, "") << "NACRE_TEST_SEED=" << one.seed << " W=" << options.lanes << " "
                       << options.target.cpu << "\n"
                       << explain(one, options);
}

CodegenOptions options_for(int lanes, Tier tier) {
  CodegenOptions options;
  options.lanes = lanes;
  options.tier = tier;
  return options;
}

constexpr int shards = 8;

class Identity : public testing::TestWithParam<int> {};

TEST_P(Identity, OfRandomProgramsAtEveryWidth) {
  const std::uint64_t count = (full_run() ? 10000 : 2000) / shards;
  const std::uint64_t first = first_seed() + count * static_cast<std::uint64_t>(GetParam());
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Program program = random_program(seed);
    ASSERT_EQ(verify(program), "") << "seed " << seed;
    const Case one(program, seed);
    for (const int lanes : {1, 4, 8, 16}) {
      expect_identity(one, options_for(lanes, seed % 2 == 0 ? Tier::quick : Tier::full));
      if (HasFatalFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shard, Identity, testing::Range(0, shards));

/// Cut into many small functions, a Program gives the same bits.
TEST(Parts, GiveTheSameBits) {
  for (std::uint64_t seed = first_seed(); seed < first_seed() + (full_run() ? 2000 : 60); ++seed) {
    const Program program = random_program(seed, {.operations = 150});
    const Case one(program, seed);
    for (const int lanes : {1, 4, 8, 16}) {
      CodegenOptions options = options_for(lanes, seed % 2 == 0 ? Tier::quick : Tier::full);
      options.uncut = 0;
      options.part = seed % 3 == 0 ? 3 : seed % 3 == 1 ? 20 : 60;
      options.line_tables = seed % 5 == 0;
      expect_identity(one, options);
      if (HasFatalFailure()) return;
    }
  }
}

/// CPUs whose code this machine can run too, and what each lacks.
TEST(Targets, GiveTheSameBits) {
  for (const char* cpu : {"x86-64-v2", "x86-64-v3", "haswell", "skylake-avx512", "znver4"}) {
    if (widest_lanes(Target::named(cpu)) > widest_lanes(Target::host())) continue;
    for (std::uint64_t seed = first_seed(); seed < first_seed() + 60; ++seed) {
      const Program program = random_program(seed);
      const Case one(program, seed);
      CodegenOptions options = options_for(seed % 3 == 0 ? 16 : seed % 3 == 1 ? 8 : 4, Tier::full);
      options.target = Target::named(cpu);
      expect_identity(one, options);
      if (HasFatalFailure()) return;
    }
  }
}

/// Uniform values computed for every lane change nothing.
TEST(Varying, ForcedEverywhereGivesTheSameBits) {
  for (std::uint64_t seed = first_seed(); seed < first_seed() + 100; ++seed) {
    Program program = random_program(seed);
    Case one(program, seed);
    mark_varying(program, true);
    expect_identity(one, options_for(seed % 2 == 0 ? 16 : 8, Tier::full));
    if (HasFatalFailure()) return;
  }
}

TEST(Threads, ShareOneKernel) {
  for (std::uint64_t seed = first_seed(); seed < first_seed() + 20; ++seed) {
    const Program program = random_program(seed);
    const Case one(program, seed);
    const auto kernel = compiled(program, options_for(16, Tier::full));
    for (const std::size_t count : {1u, 2u, 4u}) {
      std::vector<std::string> faults(count);
      std::vector<std::thread> threads;
      for (std::size_t t = 0; t < count; ++t) {
        threads.emplace_back([&, t] {
          const std::size_t start = points * t / count;
          const std::size_t end = points * (t + 1) / count;
          for (int round = 0; round < 20 && faults[t].empty(); ++round) {
            faults[t] = difference(one.expected, one.batch.run(*kernel, start, end - start), start,
                                   in_order());
          }
        });
      }
      for (std::thread& thread : threads) thread.join();
      for (const std::string& fault : faults) ASSERT_EQ(fault, "") << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace nacre
