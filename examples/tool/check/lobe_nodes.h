#pragma once

#include <nlohmann/json_fwd.hpp>

#include "examples/tool/check/lobes.h"

namespace nacre::tool {

/// Tries each lobe that LobeCheck::nodes names, alone on a surface, with several sets of inputs,
/// and prints what was found, or adds it to `all`; a fault for each law that does not hold, at the
/// nodedef.
void check_lobe_nodes(const CommonOptions& options, const LobeCheck& check, const Opened& opened,
                      nlohmann::ordered_json& all, Diagnostics& diagnostics);

}  // namespace nacre::tool
