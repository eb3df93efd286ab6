#pragma once

#include <optional>
#include <span>

#include "runtime/value/ref.h"

namespace nacre {

/// A value equal to `op` of these operands that needs no operation: x + 0,
/// x * 1, select of a known condition, ... Exact for every input, NaN included,
/// but for the sign of zero that op.h leaves open; with `keeps_sign` that, too.
std::optional<Ref> simplify(Op op, std::span<const Ref> operands, bool keeps_sign = false);

}  // namespace nacre
