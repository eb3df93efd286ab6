#pragma once

#include <vector>

#include "runtime/program/program.h"

namespace nacre::codegen {

/// The texel instructions that read the words w, w + 1, ... of the texture that
/// `first` reads w of: 1, 2 or 4 of them, `first` included, which no region
/// begins or ends between. Texels of two and four words are read like that.
std::vector<ValueId> texel_run(const Function& function, ValueId first);

}  // namespace nacre::codegen
