#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>

namespace nacre {

/// A number of the environment, to repeat or to shorten a run.
inline std::uint64_t number_of(const char* variable, std::uint64_t otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

/// How much of a sweep runs, and where its random numbers begin.
struct Tier {
  bool whole;
  std::uint64_t seed;
};

/// `make test`: a share, with the same numbers each time, so that what fails is a fault of the code
/// as it stands.
constexpr Tier daily_tier{.whole = false, .seed = 20261121};

/// `make test-full`: all of it, with other numbers each day; printed, and NACRE_TEST_SEED repeats
/// them.
inline Tier whole_tier() {
  using Days = std::chrono::duration<std::uint64_t, std::ratio<86400>>;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::uint64_t today = std::chrono::duration_cast<Days>(now).count() * 1'000'000;
  const Tier tier{.whole = true, .seed = number_of("NACRE_TEST_SEED", today)};
  fmt::print("NACRE_TEST_SEED={}\n", tier.seed);
  return tier;
}

}  // namespace nacre
