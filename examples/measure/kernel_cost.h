#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jit/compile/options.h"
#include "jit/shading/bound_kernel.h"
#include "jit/tune/kernel_run.h"
#include "jit/worker/compiler.h"
#include "runtime/diagnostic.h"

namespace nacre::measure {

/// What a part of a kernel costs.
struct CostRow {
  std::string function;  ///< An outlined one; "" for the kernel's own code.
  std::string origin;    ///< The node, by path, or lobe that was recorded; "" where nobody's.
  std::size_t operations = 0;
  double nanoseconds = 0;  ///< Of the time that a point takes.
};

struct KernelCost {
  double nanoseconds = 0;  ///< A point, on one thread, with everything in the cache.
  std::size_t samples = 0;
  std::vector<CostRow> rows;  ///< The dearest first.
  double other = 0;           ///< Nanoseconds outside the code: look-ups on the host.
  Columns results;            ///< What the kernel has computed.
};

/// Runs a kernel of the JIT for some `seconds` at points of shading_points(), but for the
/// channels that are `given`, and says where the time goes. The code is made anew, with its
/// lines. Nothing, with a diagnostic, where that cannot be.
std::optional<KernelCost> measure_cost(const BoundKernel& kernel, Compiler& compiler,
                                       const CompileOptions& options, const Columns& given,
                                       double seconds, Diagnostics& diagnostics);

}  // namespace nacre::measure
