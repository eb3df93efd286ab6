#pragma once

#include "runtime/node/componentwise.h"

namespace nacre {

/// Applies `f` to every component; for the integer overload converts its result
/// to an integer: clamped to the range of int, 0 for NaN.
template <class F>
void record_rounding(NodeCall& call, F&& f) {
  if (call.out_type() == Type::integer) {
    call.set(to_int(f(call.number("in"))));
  } else {
    componentwise(call, ports("in"), f);
  }
}

}  // namespace nacre
