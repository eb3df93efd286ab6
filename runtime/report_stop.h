#pragma once

#include <string_view>

#include "runtime/diagnostic.h"
#include "runtime/stop.h"

namespace nacre {

/// True, with an error, if `stop` is due: "stopped" where somebody asked for it, else
/// "compile-timeout". `doing` says what was going on, as in "recording the graph".
bool report_if_due(const Stop& stop, std::string_view doing, const SourceLocation& where,
                   Diagnostics& diagnostics);

}  // namespace nacre
