#pragma once

#include <string_view>

#include "runtime/program/recorder.h"
#include "runtime/value/vector.h"

namespace nacre {

/// The channel of the index of refraction outside of a surface, as of the liquid that ice swims in:
/// on the side of Ng, relative to vacuum.
inline constexpr std::string_view exterior_index_channel = "exterior_index";

/// Makes the dielectrics that are recorded from now on read that channel.
void offer_exterior_index(Recorder& recorder);

/// The channel, clamped to [0.02, 50]; a literal 1, vacuum, where it was not offered.
Float exterior_index(Recorder& recorder);

}  // namespace nacre
