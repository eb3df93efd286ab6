#pragma once

#include "examples/render/render.h"
#include "jit/shading/shading_system.h"
#include "runtime/diagnostic.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// Options of `nacre render` for host::Techniques; they write to `settings`, which lives as long as
/// `command`.
void add_techniques(CLI::App& command, host::RenderSettings& settings);

/// An error for techniques that do not go with the passes that are asked for.
void check_techniques(const host::RenderSettings& settings, Diagnostics& diagnostics);

/// Has kernels read and store what the techniques need.
void ask_for_techniques(const host::Techniques& techniques, ShaderOptions& shader);

}  // namespace nacre::tool
