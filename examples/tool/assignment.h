#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "examples/render/scene.h"
#include "jit/document/document.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

/// Which material goes on which mesh.
struct AssignmentOptions {
  std::string material;             ///< --material
  std::string look;                 ///< --look
  std::vector<std::string> assigns; ///< --assign NAME=MATERIAL

  void add(CLI::App& command);
};

/// A material name for every mesh, "" for a neutral grey. In order of strength:
/// --assign for an object, mesh or material of that name in the scene; the look's
/// materialassigns; a material of the document called as the mesh's material;
/// --material, or the document's only material, for what is left. With --material
/// alone, and neither look nor matching names, it goes on everything but the
/// built-in scene's ground and base.
std::vector<std::string> assign_materials(const Document& document, const host::Scene& scene,
                                          const AssignmentOptions& options,
                                          Diagnostics& diagnostics);

}  // namespace nacre::tool
