#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <span>
#include <utility>
#include <vector>

#include "runtime/program/program.h"

namespace nacre {

/// Numbers for KernelArguments::fitted, and the values of the parameters that they are for.
class FittedNumbers {
 public:
  FittedNumbers(std::uint32_t rows, std::vector<std::uint32_t> values)
      : numbers_(new(std::align_val_t{alignment}) float[std::size_t{rows} * Fit::cells]()),
        count_(std::size_t{rows} * Fit::cells),
        values_(std::move(values)) {}

  const float* data() const { return numbers_.get(); }
  /// From the first number of a row on.
  std::span<float> from(std::uint32_t row) {
    return std::span(numbers_.get(), count_).subspan(std::size_t{row} * Fit::cells);
  }
  /// Of ParameterFits' slots.
  const std::vector<std::uint32_t>& values() const { return values_; }

 private:
  static constexpr std::size_t alignment = 64;
  struct Delete {
    void operator()(float* numbers) const {
      ::operator delete[](numbers, std::align_val_t{alignment});
    }
  };
  std::unique_ptr<float[], Delete> numbers_;
  std::size_t count_;
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
