#include "runtime/report_stop.h"

#include <fmt/format.h>

namespace nacre {

bool report_if_due(const Stop& stop, std::string_view doing, const SourceLocation& where,
                   Diagnostics& diagnostics) {
  if (stop.is_requested()) {
    diagnostics.error("stopped", where, fmt::format("{} was stopped on request", doing));
    return true;
  }
  if (!stop.is_late()) return false;
  diagnostics.error("compile-timeout", where, fmt::format("{} takes too long", doing),
                    fmt::format("at most {} seconds", stop.seconds()));
  return true;
}

}  // namespace nacre
