#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace nacre::fuzz {

/// 1 or 0 each.
struct Result {
  std::uint64_t read = 0;
  std::uint64_t clean = 0;
  std::uint64_t ran = 0;
};

/// What one piece of work may take.
struct Budget {
  double cpu_seconds;
  double wall_seconds;  ///< For what waits rather than computes.
  double megabytes;     ///< Resident, of the whole process.
};

/// 5 s and 1 GiB, and the sanitizers' own share in a build with them.
Budget default_budget();

/// Numbered pieces of work.
struct Work {
  std::uint64_t first = 0;
  std::uint64_t count = 0;
  int jobs = 1;
  std::filesystem::path keep;     ///< Where what failed is left, with what was said.
  std::function<void()> prepare;  ///< In each process before its first piece, outside the budget.
  std::function<Result(std::uint64_t)> run;
  std::function<std::string(std::uint64_t)> text;  ///< What to keep of a piece that failed.
  Budget budget = default_budget();
};

struct Totals {
  Result sum;
  std::uint64_t failed = 0;
};

/// Runs all pieces in processes that are replaced when they die, exceed the budget or have
/// done a thousand pieces. Prints a line for each failure.
Totals run_work(const Work& work);

}  // namespace nacre::fuzz
