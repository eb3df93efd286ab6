#pragma once

#include <cstddef>
#include <vector>

#include "jit/compile/options.h"
#include "jit/compile/stage_report.h"
#include "runtime/program/program.h"

namespace nacre {

/// The passes: from what was recorded to what the engines get. Ends early, with a Program
/// that no engine takes, once there are more than `max_instructions` or the stop is due.
/// `stages` may be null.
Program lower(Program program, const CompileOptions& options,
              std::vector<StageReport>* stages = nullptr);

bool is_too_large(const Program& program, const CompileOptions& options);

}  // namespace nacre
