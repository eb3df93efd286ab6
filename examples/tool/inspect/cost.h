#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

#include "jit/compile/options.h"
#include "jit/shading/bound_kernel.h"
#include "jit/worker/compiler.h"
#include "runtime/diagnostic.h"

namespace nacre::tool {

using NamedKernel = std::pair<std::string, const BoundKernel*>;

/// What each of these kernels costs, by its name: nanoseconds of a point, and the parts of
/// it. They run in this order, and what one stores the later ones read. Null for one that
/// cannot be measured, after a diagnostic.
nlohmann::ordered_json kernel_costs(const std::vector<NamedKernel>& kernels, Compiler& compiler,
                                    const CompileOptions& options, Diagnostics& diagnostics);

/// As tables.
void print_costs(const nlohmann::ordered_json& costs);

}  // namespace nacre::tool
