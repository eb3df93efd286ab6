#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/type.h"
#include "runtime/value.h"

namespace nacre {

/// Without the white space at both ends.
std::string_view trim(std::string_view text);

/// A value as documents write it, whatever the locale. Numbers of a vector or
/// matrix are separated by a comma or by white space; of an array by commas.
/// Booleans are exactly "true" or "false". Infinities and NaN are refused, as is
/// anything left over. In arrays of strings "\," "\;" and "\\" stand for the
/// character alone (Specification, "MaterialX Data Types").
///
/// With `leftover`, text behind a number ("0.5.0", "3.7" for an integer) is
/// dropped, as the reference does, and `leftover` becomes true.
std::optional<Value> parse_value(Type type, std::string_view text, bool* leftover = nullptr);

/// What parse_value would have taken: "3 numbers", "true or false".
std::string expected_text(Type type);

/// Zero, false, the empty string or array; the identity for matrices.
/// (Specification, "Inputs".)
Value zero_value(Type type);

}  // namespace nacre
