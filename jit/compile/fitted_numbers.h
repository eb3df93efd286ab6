#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// Numbers for KernelArguments::fitted, and the values of the parameters that they are for.
class FittedNumbers {
 public:
  FittedNumbers(std::uint32_t rows, std::vector<std::uint32_t> values)
      : rows_(rows), values_(std::move(values)) {}

  const float* data() const { return rows_.front().numbers.data(); }
  /// From the first number of a row on.
  std::span<float> from(std::uint32_t row) {
    return {rows_[row].numbers.data(), (rows_.size() - row) * Fit::cells};
  }
  /// Of ParameterFits' slots.
  const std::vector<std::uint32_t>& values() const { return values_; }

 private:
  struct alignas(64) Row {
    std::array<float, Fit::cells> numbers{};
  };
  std::vector<Row> rows_;
  std::vector<std::uint32_t> values_;
};

/// What was fitted last for somebody's parameters, which change less often than they are used. Any
/// number of threads may use it.
class LastFitted {
 public:
  std::shared_ptr<const FittedNumbers> get() const {
    const std::scoped_lock lock(mutex_);
    return numbers_;
  }
  void set(std::shared_ptr<const FittedNumbers> numbers) {
    const std::scoped_lock lock(mutex_);
    numbers_ = std::move(numbers);
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const FittedNumbers> numbers_;
};

}  // namespace nacre
