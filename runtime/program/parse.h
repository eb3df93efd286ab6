#pragma once

#include <optional>
#include <string_view>

#include "runtime/diagnostic.h"
#include "runtime/program/program.h"

namespace nacre {

/// The Program that to_string() printed: printing it again gives the same text.
/// Inputs and outputs are listed in the order in which instructions name them,
/// types and operands are checked with verify(), and varying is marked. A fault
/// gives one diagnostic, "program-syntax" or "program-invalid", with its line in
/// `file`; any text is safe to give.
std::optional<Program> parse_program(std::string_view text, Diagnostics& diagnostics,
                                     std::string_view file = {});

}  // namespace nacre
