#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "examples/tool/check/lobe_laws.h"
#include "examples/tool/options.h"

namespace nacre::tool {

/// What `nacre check --lobes` and `--lobe` look at, and how.
struct LobeCheck {
  bool materials = false;          ///< Those of the document.
  std::vector<std::string> nodes;  ///< Nodes or nodedefs whose output is a BSDF.
  std::size_t sets = 8;            ///< Of inputs that each of these is tried with.
  bool json = false;
  LobeEffort effort;

  bool is_wanted() const { return materials || !nodes.empty(); }
};

/// Compiles what is asked for and prints what leaves of the light, or that it has no closure, or
/// with `json` adds it to `found`; a fault for each law that does not hold. Texts are not held to
/// what lobes promise.
void check_lobes(const CommonOptions& options, const LobeCheck& check, const Opened& opened,
                 nlohmann::ordered_json& found, Diagnostics& diagnostics);

}  // namespace nacre::tool
