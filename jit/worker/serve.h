#pragma once

#include <functional>
#include <optional>

#include "jit/worker/message.h"

namespace nacre {

/// As compile_object() does it; may throw std::bad_alloc.
using Compile =
    std::function<std::optional<ObjectCode>(const CompileRequest&, Diagnostics&, CompileStats&)>;

/// What nacre-compile-worker does: answers requests from its socket until the host is gone.
/// It may take `megabytes` of address space, 0: any; where memory or LLVM ends, it ends.
/// Returns the exit status.
int serve_compiles(const Compile& compile, unsigned long megabytes);

}  // namespace nacre
