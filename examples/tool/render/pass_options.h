#pragma once

#include <string>
#include <utility>
#include <vector>

#include "examples/render/passes.h"
#include "examples/render/scene.h"
#include "jit/shading/shading_system.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// Which images beside the picture `nacre render` is asked for.
struct PassOptions {
  std::vector<std::string> names;   ///< --aov
  std::vector<std::string> groups;  ///< --light-group NAME=PATTERN[,PATTERN...]

  void add(CLI::App& command);
  bool any() const { return !names.empty() || !groups.empty(); }
};

/// What the options say of passes: known ones, mattes and values of graphs, whose components
/// nobody knows yet; and the names of groups. Errors for what is no such.
host::PassRequest pass_request(const PassOptions& options, Diagnostics& diagnostics);

/// Has kernels store what the passes need.
void ask_for_passes(const host::PassRequest& passes, KernelRequest& request);

/// The components of values, as the kernels of a material have them; an error for what has more
/// than a layer.
void look_for_values(const MaterialKernels& kernels, host::PassRequest& passes,
                     Diagnostics& diagnostics);

/// Adds the values' passes, once all materials were looked at; an error for what none has.
void complete_values(host::PassRequest& passes, Diagnostics& diagnostics);

/// Which lights are in which group: by the names of meshes (object, mesh, material) and of
/// `lights`, and "environment". A pattern that is nothing's name is an error. Adds the groups'
/// passes, and that of the rest.
void complete_groups(const PassOptions& options, const host::Scene& scene,
                     const std::vector<std::string>& lights, host::PassRequest& passes,
                     Diagnostics& diagnostics);

/// The list of what there is, for --help.
std::string pass_help();

}  // namespace nacre::tool
