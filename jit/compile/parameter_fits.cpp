#include "jit/compile/parameter_fits.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "jit/passes/tabulate/fit.h"
#include "runtime/float_environment.h"
#include "runtime/interpreter/interpreter.h"

namespace nacre {

namespace {

/// Values that are remembered for calls that have nobody's parameters.
constexpr std::size_t most_known = 64;

Fits fits_of(const Kernel& kernel) {
  const auto* made = dynamic_cast<const CompiledKernel*>(&kernel);
  if (made != nullptr) return made->fits();
  return {kernel.program().fits, kernel.program().fitted_rows};
}

}  // namespace

std::shared_ptr<const ParameterFits> ParameterFits::make(const Kernel& kernel) {
  Fits fits = fits_of(kernel);
  if (fits.list.empty()) return nullptr;
  const std::size_t count = kernel.program().parameters.size();
  const auto is_of_kernel = [&](const Fit& fit) {
    return std::ranges::all_of(fit.slots, [&](std::uint32_t slot) { return slot < count; });
  };
  if (!std::ranges::all_of(fits.list, is_of_kernel)) return nullptr;
  return std::shared_ptr<const ParameterFits>(new ParameterFits(std::move(fits)));
}

ParameterFits::ParameterFits(Fits fits) : fits_(std::move(fits)) {
  for (const Fit& fit : fits_.list) {
    makers_.push_back(make_interpreter(*fit.maker));
    slots_.insert(slots_.end(), fit.slots.begin(), fit.slots.end());
  }
  std::ranges::sort(slots_);
  const auto [first, last] = std::ranges::unique(slots_);
  slots_.erase(first, last);
}

std::shared_ptr<const FittedNumbers> ParameterFits::of(std::span<const std::uint32_t> parameters,
                                                       LastFitted* last) const {
  if (!process_.is_this()) return fit(parameters);
  if (last == nullptr) return known_or_fit(parameters);
  const auto value = [&](std::uint32_t slot) { return parameters[slot]; };
  auto numbers = last->get();
  if (numbers != nullptr && std::ranges::equal(slots_, numbers->values(), {}, value)) {
    return numbers;
  }
  numbers = fit(parameters);
  last->set(numbers);
  return numbers;
}

std::shared_ptr<const FittedNumbers> ParameterFits::known_or_fit(
    std::span<const std::uint32_t> parameters) const {
  std::vector<std::uint32_t> values;
  for (const std::uint32_t slot : slots_) values.push_back(parameters[slot]);
  const std::uint64_t key = std::hash<std::string_view>{}(
      {reinterpret_cast<const char*>(values.data()), sizeof(std::uint32_t) * values.size()});
  {
    const std::scoped_lock lock(mutex_);
    const auto found = known_.find(key);
    if (found != known_.end() && found->second->values() == values) return found->second;
  }
  std::shared_ptr<const FittedNumbers> made = fit(parameters);
  const std::scoped_lock lock(mutex_);
  if (known_.size() >= most_known) known_.clear();
  known_[key] = made;
  return made;
}

std::shared_ptr<const FittedNumbers> ParameterFits::fit(
    std::span<const std::uint32_t> parameters) const {
  const ScopedDefaultFloatEnvironment environment;  // Of a host there may be another.
  std::vector<std::uint32_t> values;
  for (const std::uint32_t slot : slots_) values.push_back(parameters[slot]);
  auto made = std::make_shared<FittedNumbers>(fits_.rows, std::move(values));
  std::vector<std::uint32_t> slots;
  for (std::size_t i = 0; i < makers_.size(); ++i) {
    const Fit& fit = fits_.list[i];
    slots.clear();
    for (const std::uint32_t slot : fit.slots) slots.push_back(parameters[slot]);
    const std::vector<std::vector<float>> functions = fit_values(fit, *makers_[i], slots);
    bool is_close = !functions.empty();
    for (std::size_t k = 0; k < functions.size() && is_close; ++k) {
      const auto row = fit.row + Fit::coefficients * static_cast<std::uint32_t>(k);
      is_close = fit_cells(fit, functions[k], made->from(row));
    }
    made->from(0)[i] = is_close ? 1.0f : 0.0f;
  }
  return made;
}

}  // namespace nacre
