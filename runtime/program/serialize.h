#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/program/program.h"

namespace nacre {

/// A Program as bytes, for another process of this machine and this build.
std::string to_bytes(const Program& program);

/// Nothing for what to_bytes() has not made, as far as that shows: verify() says the rest.
std::optional<Program> program_from_bytes(std::string_view bytes);

/// Program::fits alone; empty where there are none.
std::string fits_to_bytes(const Program& program);
/// Gives a Program those; false for what is not of fits_to_bytes().
bool take_fits(std::string_view bytes, Program& program);

}  // namespace nacre
