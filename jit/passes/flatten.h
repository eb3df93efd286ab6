#pragma once

#include <cstddef>

#include "runtime/program/program.h"
#include "runtime/program/transform.h"

namespace nacre {

/// What an operation takes, in additions, where each lane's numbers are at hand; infinite where no
/// select stands for it.
double cost_of(Op op);

/// Which if_any regions of a Program, that has to live as long, cost less than a test. This is
/// the one place that decides what is worth a branch: whoever records marks what only some
/// lanes need, however little that is.
Flattening cheap_regions(const Program& program);

/// `program` with cheap_regions() made straight: their bodies run for all lanes, and each
/// merge becomes a select, with the same bits.
Program flatten_regions(const Program& program, std::size_t most = std::size_t{1} << 31);

}  // namespace nacre
