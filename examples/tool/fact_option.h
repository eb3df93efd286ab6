#pragma once

#include <vector>

#include "jit/compile/facts.h"

namespace CLI {
class App;
}

namespace nacre::tool {

/// --fact; what is said goes to `facts`, which live as long as `command`.
void add_facts(CLI::App& command, std::vector<Fact>& facts);

}  // namespace nacre::tool
