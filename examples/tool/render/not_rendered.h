#pragma once

#include <set>
#include <string>
#include <vector>

#include "examples/render/scene.h"
#include "examples/tool/options.h"

namespace nacre::tool {

/// Says what a document has and `render` leaves out, each thing once.
class NotRendered {
 public:
  NotRendered(const Opened& opened, Diagnostics& diagnostics);

  /// What the kernels of a material leave out, and inputs of its shader nodes that are set
  /// and that the shading model's own graph does not read.
  void look_at_material(const std::string& name, const MaterialKernels& kernels);

  /// Meshes of a material that displaces, and that stay where they are.
  void look_at_displaced(const std::string& material, const std::vector<const host::Mesh*>& meshes,
                         bool displaces);

  /// Meshes of a material with a medium inside that are no solids.
  void look_at_solids(const std::string& material, const std::vector<const host::Mesh*>& meshes);

 private:
  void look_at_shader(const Element& input);
  void look_at_inputs(const Element& shader);

  const Opened& opened_;
  Diagnostics& diagnostics_;
  Definitions definitions_;
  std::set<std::string> said_;
};

}  // namespace nacre::tool
