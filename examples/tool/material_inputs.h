#pragma once

#include <string>
#include <vector>

#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// The graph outputs, as build_graph names them, that feed the surface shader of
/// a material, each once: what a bake of that material consists of. An error if there is
/// no such material.
std::vector<std::string> material_inputs(const Document& document, const std::string& material,
                                         Diagnostics& diagnostics);

}  // namespace nacre::tool
