#pragma once

#include <functional>
#include <vector>

#include "runtime/program/program.h"

namespace nacre::codegen {

/// The instructions that read the words w, w + 1, ... of the texture or table that
/// `first`, a texel or table instruction, reads w of: 1, 2 or 4 of them, which no
/// region begins or ends between. They are read together. `first` comes first, and
/// no_value stands for a word in between that nothing reads. Only such as `goes_along`.
std::vector<ValueId> word_run(const Function& function, ValueId first,
                              const std::function<bool(ValueId)>& goes_along);

}  // namespace nacre::codegen
