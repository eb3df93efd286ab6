#pragma once

#include <vector>

#include "jit/compile/options.h"
#include "jit/compile/stage_report.h"
#include "runtime/program/program.h"

namespace nacre {

// The passes, in two parts: from what was recorded to what names a kernel in the cache, and
// from there to what the engines get. Both end early, with a Program that no engine takes,
// once there are more than `max_instructions` or the stop is due. `stages` may be null.

/// What decides which arrays are bound: the channels and slots are those of the kernel.
Program lower_to_interface(Program program, const CompileOptions& options,
                           std::vector<StageReport>* stages = nullptr);
/// The rest, which costs more than a kernel that is cached.
Program lower_to_engine(Program program, const CompileOptions& options,
                        std::vector<StageReport>* stages = nullptr);

/// Both.
Program lower(Program program, const CompileOptions& options,
              std::vector<StageReport>* stages = nullptr);

/// Whether CompileOptions::facts say something of what it reads: then lower_to_engine() gives it
/// the output of with_check().
bool has_check(const Program& program, const CompileOptions& options);

bool is_too_large(const Program& program, const CompileOptions& options);

}  // namespace nacre
