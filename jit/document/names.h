#pragma once

#include <string_view>

#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre {

/// True for what the standard allows as a name, letters, digits and
/// underscores not starting with a digit, with any number of "ns:" before it.
bool is_valid_name(std::string_view name);

/// Adds an error for each name and namespace below `root` that is none, and for each name
/// that one scope has twice.
void check_names(const Document& document, const Element& root, Diagnostics& diagnostics);

}  // namespace nacre
