#pragma once

#include "jit/llvm/session.h"

namespace nacre {

/// Runs code compiled for `lanes` on any number of points, in the environment
/// that kernels need. Code knows whole batches only: the last points, if they
/// are fewer than `lanes`, go through copies filled up with the last one, so nothing
/// beyond the host's arrays is touched.
RunStatus run_code(LoadedCode::Entry entry, const Program& program, int lanes,
                   const StepLimit& limit, const KernelArguments& arguments);

}  // namespace nacre
