#pragma once

#include <array>
#include <cstddef>
#include <memory>

namespace nacre {

/// Room for `count` elements, on the stack as long as they are few.
template <class T, std::size_t usual>
class Room {
 public:
  explicit Room(std::size_t count) {
    if (count > usual) heap_ = std::make_unique_for_overwrite<T[]>(count);
  }
  T* data() { return heap_ != nullptr ? heap_.get() : stack_.data(); }

 private:
  std::array<T, usual> stack_;
  std::unique_ptr<T[]> heap_;
};

}  // namespace nacre
