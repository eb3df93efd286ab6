#pragma once

#include <span>
#include <string>

namespace nacre {

/// Whether a name fits one of the patterns, in which `*` stands for any text, slashes and dots
/// too, and `?` for one letter.
bool fits_any(const std::string& name, std::span<const std::string> patterns);

}  // namespace nacre
