#pragma once

#include <functional>
#include <string_view>

#include "runtime/program/program.h"

namespace nacre {

/// The same computation with some input channels the same for a whole batch:
/// each channel that `fixed` names becomes a slot of the parameter block, of the
/// channel's name and with value 0, which the host fills before a call. What
/// depends on nothing else is then computed once a call.
Program fix_inputs(const Program& program, const std::function<bool(std::string_view)>& fixed);

}  // namespace nacre
