#pragma once

#include "examples/tool/lobe_laws.h"
#include "examples/tool/options.h"

namespace nacre::tool {

/// How `nacre check --lobes` looks at the materials of a document.
struct LobeCheck {
  bool is_wanted = false;
  bool json = false;
  LobeEffort effort;
};

/// Compiles every material and prints what leaves of the light, or that it has no closure; a fault
/// for each law that does not hold.
void check_lobes(const CommonOptions& options, const LobeCheck& check, const Opened& opened,
                 Diagnostics& diagnostics);

}  // namespace nacre::tool
