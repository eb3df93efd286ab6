#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "pbs/tables/facet_tables.h"
#include "runtime/program/recorder.h"
#include "runtime/value/value.h"

namespace nacre {

/// All quantities of a table at a place given by coordinates in [0, 1] (angle,
/// roughness, index; clamped), linear between nodes. An axis along which the
/// coordinate is a literal is folded: the kernel then holds a smaller table.
std::vector<Float> look_up(Recorder& recorder, const FacetTable& table, Float angle,
                           Float roughness, Float index = 0.0f);

}  // namespace nacre
