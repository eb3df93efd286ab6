#pragma once

#include <cstddef>

#include "runtime/program/program.h"

namespace nacre {

/// `program` with every if_any region that costs less than a test made straight: its body
/// runs for all lanes, and each merge becomes a select, with the same bits. This is the one
/// place that decides what is worth a branch: whoever records marks what only some lanes
/// need, however little that is.
Program flatten_regions(const Program& program, std::size_t most = std::size_t{1} << 31);

}  // namespace nacre
