#pragma once

#include <cstdint>

#include "tests/pbs/battery/closure_kernels.h"

namespace nacre {

/// Tries the laws of closure_laws.h on so many hostile points of a row, all its forms together.
/// What breaks one fails the running test, with the point and its seed. Seeds count from `seed`.
void try_closure(const ClosureCase& row, const ClosureWay& way, std::size_t points,
                 std::uint64_t seed);

}  // namespace nacre
