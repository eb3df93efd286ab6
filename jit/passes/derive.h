#pragma once

#include <span>
#include <string_view>

#include "runtime/program/program.h"

namespace nacre {

/// Derivatives of derivatives of ... a Program may ask for; what nests deeper
/// takes the innermost ones for constants.
inline constexpr int max_derivative_order = 3;

/// `program` with every `ddx %x` (imm 0: along x, 1: along y) replaced by the
/// exact forward-mode derivative of %x along that axis of the shading point's
/// footprint, and no ddx left. jit/passes/footprint.h says which input channels
/// have a derivative, what channel it is read from and what `more` is;
/// jit/passes/tangent.cpp lists the rule of every operation. A ddx is finite:
/// where the derivative is not, it is 0.
///
/// Tangents are computed beside the values they belong to, only where a ddx
/// needs them: through merges, carried along loops, and by variants of outlined
/// functions that take and return them. What stands in for another value has that one's, and
/// is no more than itself afterwards: no stand_in is left. A ddx of what contains a ddx is the
/// second derivative. Taken to be 0: the derivatives of texture words and of
/// texture_call results, and of a ddx that a loop feeds back into itself.
///
/// Run it on a slice that was not cut before the ddx: across a cut at a keep
/// ("state.<k>" channels) derivatives are 0. Run it before `expand_math`. Ends early as
/// `transform` does, with more than `most` instructions.
Program derive(const Program& program, std::span<const std::string_view> more = {},
               std::size_t most = std::size_t{1} << 31);

}  // namespace nacre
