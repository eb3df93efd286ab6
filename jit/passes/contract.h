#pragma once

#include "runtime/program/program.h"

namespace nacre {

/// `program` with products fused into the sums they go to, each rounded once
/// instead of twice:
///
///   a b + c  ->  fma(a, b, c)         a b - c  ->  fma(a, b, -c)
///   c - a b  ->  fma(-a, b, c)       -(a b) + c  ->  fma(-a, b, c)
///   c - -(a b)  ->  fma(a, b, c)     -(a b) - c  ->  fma(-a, b, -c)
///
/// The signs are moved exactly, and where the moved sign meets a literal or
/// another neg it costs nothing. A product is fused only if all its uses are
/// such sums, so that it vanishes, and a sum fuses at most one product: of two,
/// the one with fewer uses, then the one that is more operations deep. A product of uniform values
/// is not fused into a varying sum: it is computed once a call, not once a point. Only direct
/// operands fuse: a keep, a call, a merge or a select between product and sum stays between them.
///
/// The same Program always gives the same result, and one that computes the same in another
/// order the same bits (see structure.h). As with any contraction,
/// a b - c d is no longer exactly 0 where both products are equal; write what
/// must not be fused with fma, or run without this pass (`precise`). It must
/// run before `expand_math`, whose error-compensated sequences mean what they say.
///
/// With `flattens`, what flatten_regions() does is done on the way.
Program contract(const Program& program, bool flattens = false);

}  // namespace nacre
