#pragma once

#include <algorithm>
#include <chrono>
#include <stop_token>
#include <utility>

namespace nacre {

/// When long work ends early: at a time, when somebody asks for it, or both. Passed by value
/// through everything between a document and its kernels; what looks at it does so often
/// enough that nothing goes on for more than about a tenth of a second after it is due.
class Stop {
 public:
  /// Goes on whatever the date does.
  using Clock = std::chrono::steady_clock;

  /// Never.
  Stop() = default;
  /// When a stop is requested of the token's source.
  explicit Stop(std::stop_token token) : token_(std::move(token)) {}

  /// The same, but no later than `seconds` from now.
  Stop within(double seconds) const {
    // Beyond what a clock can count is no limit, nor is NaN.
    if (!(seconds < 1e9)) return *this;
    const auto wait = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(seconds > 0 ? seconds : 0));
    const Clock::time_point then = Clock::now() + wait;
    if (deadline_ <= then) return *this;
    Stop sooner = *this;
    sooner.deadline_ = then;
    sooner.seconds_ = seconds > 0 ? seconds : 0;
    return sooner;
  }

  /// Somebody asked for it.
  bool is_requested() const { return token_.stop_requested(); }
  /// The deadline has come.
  bool is_late() const {
    return deadline_ != Clock::time_point::max() && Clock::now() >= deadline_;
  }
  /// Either.
  bool is_due() const { return is_requested() || is_late(); }

  /// Without a source: nobody can ask.
  const std::stop_token& token() const { return token_; }
  /// time_point::max() where there is none.
  Clock::time_point deadline() const { return deadline_; }
  /// What `within` was given for the deadline, for diagnostics; 0 without one.
  double seconds() const { return seconds_; }

 private:
  std::stop_token token_;
  Clock::time_point deadline_ = Clock::time_point::max();
  double seconds_ = 0;
};

}  // namespace nacre
