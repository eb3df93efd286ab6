#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/type.h"
#include "runtime/value.h"

/// What GraphOptions::lenient reads as MaterialX 1.39.5's generated code does, although the
/// standard has no meaning for it.
namespace nacre {

/// True where a value of one type stands for one of another: a number for every component,
/// a colour for a vector of as many, and back; as the generated GLSL has it.
bool stands_for(Type from, Type to);

/// The value as that type; `stands_for` is true.
Value as_type(const Value& value, Type to);

/// A value with commas, or the "f" or ";" of a programming language, that should not be
/// there; where one number is wanted, the first of several. Nothing where that does not help,
/// or where it would mean another number than its author will have: "1/2", "50%", "0x10".
std::optional<Value> parse_lenient(Type type, std::string_view text);

/// What has become of such a value, for a warning: "10 is used".
std::string lenient_reading(const Value& value);

}  // namespace nacre
