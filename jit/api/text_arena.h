#pragma once

#include <cstring>
#include <memory_resource>
#include <string_view>

namespace nacre::api {

/// Copies of texts, each with a 0 at its end, for hosts. They live as long as this.
class TextArena {
 public:
  const char* keep(std::string_view text) {
    if (text.empty()) return "";
    auto* copy = static_cast<char*>(memory_.allocate(text.size() + 1, 1));
    std::memcpy(copy, text.data(), text.size());
    copy[text.size()] = '\0';
    return copy;
  }

 private:
  std::pmr::monotonic_buffer_resource memory_;
};

}  // namespace nacre::api
