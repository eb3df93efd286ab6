#pragma once

#include "pbs/profile/profile_tables.h"
#include "runtime/value/vector.h"

namespace nacre {

/// A direction by its components along the profile's x, y and z, unit up to rounding, by u in
/// [0, 1): with the density that `tables`, which are the profile's, are of. Nowhere dark.
Float3 sample_profile(Recorder& recorder, const LightProfile& profile, const ProfileTables& tables,
                      Float3 u);

/// By what the density of a direction is larger than the intensity there, by solid angle, but for
/// ProfileTables::total.
Float profile_weight(LightProfile::Type type, Float3 direction);

}  // namespace nacre
