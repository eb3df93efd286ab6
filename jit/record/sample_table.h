#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "jit/graph/text_table.h"
#include "runtime/program/recorder.h"
#include "runtime/value/value.h"

namespace nacre {

/// Puts the numbers of a table into the Program that is recorded; tables of equal
/// numbers are one.
std::uint32_t add_table(Recorder& recorder, const TextTable& table);

/// Records a look-up in a table (see TextTable) that add_table gave `index`. One
/// coordinate an axis, x first; axes without one are read at their first texel. A
/// coordinate that is no number reads the first texel.
std::array<Float, 4> sample_table(Recorder& recorder, const TextTable& table, std::uint32_t index,
                                  std::span<const Float> place);

}  // namespace nacre
