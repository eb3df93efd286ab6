#pragma once

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace nacre::host {

// Numbers as this machine has them, in files that no other one reads.

template <class T>
void append_numbers(std::string& bytes, const std::vector<T>& numbers) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
}

/// Takes as many as `numbers` has from the front. False, and nothing is done, where there are not.
template <class T>
bool take_numbers(std::string_view& bytes, std::vector<T>& numbers) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t size = numbers.size() * sizeof(T);
  if (bytes.size() < size) return false;
  if (size > 0) std::memcpy(numbers.data(), bytes.data(), size);
  bytes.remove_prefix(size);
  return true;
}

}  // namespace nacre::host
