#include "jit/record/pattern.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace nacre {

/// What the last `*` stands for grows by a letter whenever the rest does not fit: one star may
/// take whatever those before it left, so nothing else has to be tried again.
bool fits_pattern(std::string_view name, std::string_view pattern) {
  std::size_t at = 0;
  std::size_t star = std::string_view::npos;  // Behind the last one passed,
  std::size_t taken = 0;                      // which stands for what ends here.
  std::size_t next = 0;
  while (at < name.size()) {
    if (next < pattern.size() && pattern[next] == '*') {
      star = ++next;
      taken = at;
    } else if (next < pattern.size() && (pattern[next] == '?' || pattern[next] == name[at])) {
      ++next;
      ++at;
    } else if (star != std::string_view::npos) {
      next = star;
      at = ++taken;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', next) == std::string_view::npos;
}

bool fits_any(const std::string& name, std::span<const std::string> patterns) {
  return std::ranges::any_of(
      patterns, [&](const std::string& pattern) { return fits_pattern(name, pattern); });
}

}  // namespace nacre
