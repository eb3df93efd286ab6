#pragma once

#include <utility>

#include "runtime/value/control.h"

namespace nacre {

namespace detail {

/// Where a root is sought.
struct RootBracket {
  Float low, high, at;
  template <class F>
  friend void visit(RootBracket& bracket, F&& f) {
    f(bracket.low), f(bracket.high), f(bracket.at);
  }
};

}  // namespace detail

/// Where a function that does not decrease passes 0 between `low` and `high`, to 1e-6: by Newton's
/// steps from `start`, and by halves where they lead out of what is left. For a distribution less
/// a random number that inverts it. `function(x)` gives a pair, the value and the derivative at x;
/// any numbers of them end somewhere in [low, high].
template <class F>
Float find_root(Recorder& recorder, Float low, Float high, Float start, F&& function) {
  constexpr int most_rounds = 20;
  const detail::RootBracket begin{low, high, start};
  return loop(recorder, Bool(true), most_rounds, begin,
              [&](Int, detail::RootBracket& bracket) {
                const auto [value, slope] = function(bracket.at);
                const Bool above = value > 0.0f;
                bracket.high = select(above, bracket.at, bracket.high);
                bracket.low = select(above, bracket.low, bracket.at);
                const Float next = bracket.at - value / slope;
                const Bool inside = (next >= bracket.low) & (next <= bracket.high);
                const Float before = bracket.at;
                bracket.at = select(inside, next, 0.5f * (bracket.low + bracket.high));
                return abs(bracket.at - before) > 1e-6f;
              })
      .at;
}

/// Where within [0, 1] a density that goes from `first` to `last` in a line, both at least 0, has
/// the share q of itself below; q where both are 0. pbrt-v4, "SampleLinear".
Float invert_linear(Float first, Float last, Float q);

}  // namespace nacre
