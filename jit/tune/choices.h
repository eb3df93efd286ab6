#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "jit/shading/shading_system.h"

namespace nacre {

/// A setting of each of dimensions(), by its number there: 0 is the most exact.
using Choices = std::vector<std::size_t>;

Choices exact_choices();
/// What is compiled where nothing is said: standard accuracy, all else exact.
Choices standard_choices();

void apply_choices(const Choices& choices, ShaderOptions& options);

/// Those that are not exact, "accuracy=fast anisotropy=4"; "exact".
std::string to_string(const Choices& choices);

}  // namespace nacre
