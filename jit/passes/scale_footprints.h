#pragma once

#include "runtime/program/program.h"

namespace nacre {

/// Gives a Program that has a ddx the slot "footprint_scale", f32, 1 unless set; the channel of
/// that name if `varying`. It is read by what scale_footprints() makes of the Program.
void offer_footprint_scale(Program& program, bool varying);

/// What `made`, by derive() of `program`, has to have of that: nothing, if it reads no changes.
void keep_footprint_scale(const Program& program, Program& made);

/// Whether a Program has that slot or channel.
bool offers_footprint_scale(const Program& program);

/// `program` with every change that it reads, as dPdx or duv0dy, multiplied by that number, which
/// counts as the nearest in [0, 1e6] where it is outside and as 0 where it is NaN. To be run behind
/// all passes that choose what is rounded: so the results are those of a host that multiplies.
Program scale_footprints(const Program& program);

}  // namespace nacre
