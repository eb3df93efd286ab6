#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace nacre {

/// The one or two closures that a closure of the same kind is made of; null where nothing
/// is connected. One closure may be part of several. However long a chain of them is, it
/// ends without recursion.
template <class T>
class ClosureParts {
 public:
  using Pointer = std::shared_ptr<const T>;  ///< Null: not connected.
  static constexpr std::size_t count = 2;    ///< Of parts, connected or not.

  /// Null for what is not connected.
  explicit ClosureParts(Pointer first = nullptr, Pointer second = nullptr)
      : parts_{std::move(first), std::move(second)} {}
  ~ClosureParts() {
    std::vector<Pointer> ending;
    take(ending);
    while (!ending.empty()) {
      const Pointer last = std::move(ending.back());
      ending.pop_back();
      // Nobody else has it, so its parts would end within its own end.
      if (last.use_count() == 1) last->parts().take(ending);
    }
  }
  ClosureParts(const ClosureParts&) = delete;
  ClosureParts& operator=(const ClosureParts&) = delete;

  /// Part `i`, less than `count`; may be null.
  const Pointer& operator[](std::size_t i) const { return parts_[i]; }

 private:
  void take(std::vector<Pointer>& ending) const {
    for (Pointer& part : parts_) {
      if (part != nullptr) ending.push_back(std::move(part));
    }
  }

  mutable std::array<Pointer, count> parts_;
};

}  // namespace nacre
