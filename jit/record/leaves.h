#pragma once

#include <string>

#include "jit/graph/graph.h"
#include "jit/record/record.h"

namespace nacre {

// What feeds an input where no node does.

/// A value of that type, folded in.
Recorded literal(const Source& source, Type type, const RecordOptions& options);

/// What an author wrote: slots of the parameter block, or folded in as `options` say. Text
/// always is.
Recorded parameter(const Parameter& parameter, const RecordOptions& options, Recorder& recorder);

/// Whether a parameter becomes slots of the block: the mode says so, of what an author wrote, or
/// one of the patterns fits its path. `*` stands for any text, `?` for one letter.
bool is_live(const Parameter& parameter, const RecordOptions& options);

/// Slot name of component `i` of a parameter of `count` components.
std::string slot_name(const std::string& parameter, int i, int count);

}  // namespace nacre
