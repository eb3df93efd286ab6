#pragma once

#include <memory>
#include <string>

#include "runtime/kernel.h"

namespace nacre {

enum class Engine { interpreter, jit };

/// A kernel for an expanded Program; null, with the reason in `error`, if the
/// engine can't.
std::shared_ptr<const Kernel> make_kernel(Program program, Engine engine, Accuracy accuracy,
                                          std::string& error);

}  // namespace nacre
