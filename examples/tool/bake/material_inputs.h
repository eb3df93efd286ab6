#pragma once

#include <string>
#include <vector>

#include "examples/tool/options.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// The graph outputs, as build_graph names them, that feed the surface shader of
/// a material, each once: what a bake of that material consists of. An error if there is
/// no such material. `lenient`: as GraphOptions has it.
std::vector<std::string> material_inputs(const Opened& opened, const std::string& material,
                                         bool lenient, Diagnostics& diagnostics);

}  // namespace nacre::tool
