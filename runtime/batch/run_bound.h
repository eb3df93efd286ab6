#pragma once

#include <cstdint>
#include <functional>

#include "runtime/batch/binder.h"
#include "runtime/kernel.h"

namespace nacre {

/// Runs a kernel on arrays in KernelArguments' own form.
using RunArrays =
    std::function<RunStatus(const void* const* inputs, void* const* outputs, std::uint64_t count)>;

/// Runs `run` on the points of a batch. Arrays that lie as kernels want them are handed over
/// where they are; others are copied, some points at a time so that the copies stay in the
/// level-1 cache, and results are written to where they belong. What a point gets does not
/// depend on how its numbers came. `wrong_arguments` where the batch has fewer arrays than the
/// binding names, or no list of instances that it needs.
RunStatus run_bound(const Binding& binding, const Batch& batch, const RunArrays& run);

}  // namespace nacre
