#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pbs/profile/light_profile.h"

namespace nacre {

/// What is wrong with a file, and where.
struct IesFault {
  int line = 0;  ///< From 1.
  std::string message, expected, found;
};

/// A file of IESNA LM-63, of 1986 to 2019. Keywords and what depends on the tilt of the lamp are
/// passed over: it stands as it was measured. Lamps, multipliers and ballast factors scale the
/// intensity. Nothing, with the first fault, for what is no such file.
std::optional<LightProfile> parse_ies(std::string_view text, IesFault& fault);

}  // namespace nacre
