#pragma once

#include <vector>

#include "jit/compile/options.h"
#include "runtime/program/program.h"

namespace nacre {

/// What CompileOptions::facts of parameters say of the state that `begin`, one of a material's
/// Programs, stores: for those that load it. These get the slots of such parameters, so that each
/// kernel can tell whether what it loads is as was said. Nothing where there is no begin.
std::vector<Fact> state_facts(std::vector<Program>& programs, const CompileOptions& options);

}  // namespace nacre
