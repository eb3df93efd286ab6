#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "jit/compile/fitted_numbers.h"
#include "jit/service/compile_service.h"
#include "runtime/kernel.h"
#include "runtime/process.h"

namespace nacre {

/// Fits what a kernel reads for the values that its parameters have: in some ten microseconds, and
/// once for those that calls have had lately. Used by any number of threads; in a child of fork(),
/// which shares no locks, once a call.
class ParameterFits {
 public:
  /// Null where the kernel reads nothing that is fitted.
  static std::shared_ptr<const ParameterFits> make(const Kernel& kernel);

  /// `parameters`: a slot each of the kernel's Program. `last`: of who has them from call to call;
  /// may be null.
  std::shared_ptr<const FittedNumbers> of(std::span<const std::uint32_t> parameters,
                                          LastFitted* last = nullptr) const;

 private:
  explicit ParameterFits(Fits fits);
  std::shared_ptr<const FittedNumbers> known_or_fit(
      std::span<const std::uint32_t> parameters) const;
  std::shared_ptr<const FittedNumbers> fit(std::span<const std::uint32_t> parameters) const;

  const Process process_;
  Fits fits_;
  std::vector<std::unique_ptr<const Kernel>> makers_;  ///< One a fit.
  std::vector<std::uint32_t> slots_;                   ///< That any of them reads.
  mutable std::mutex mutex_;
  /// By a digest of the values.
  mutable std::unordered_map<std::uint64_t, std::shared_ptr<const FittedNumbers>> known_;
};

}  // namespace nacre
