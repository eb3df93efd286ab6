#pragma once

#include <span>
#include <string>
#include <string_view>

namespace nacre {

/// Whether a name fits a pattern, in which `*` stands for any text, slashes and dots too, and `?`
/// for one letter.
bool fits_pattern(std::string_view name, std::string_view pattern);
/// Whether it fits one of them.
bool fits_any(const std::string& name, std::span<const std::string> patterns);

}  // namespace nacre
