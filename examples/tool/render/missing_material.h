#pragma once

#include <string>

#include "examples/tool/options.h"

namespace nacre::tool {

/// Says why a document has no material of that name: what else is called so, or what
/// `check` finds wrong with it. Nothing where nothing is called so.
void explain_missing_material(const Opened& opened, const std::string& name,
                              const ShaderOptions& options, Diagnostics& diagnostics);

}  // namespace nacre::tool
