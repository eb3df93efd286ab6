#pragma once

#include <memory>
#include <vector>

#include "jit/compile/options.h"
#include "jit/compile/stage_report.h"
#include "jit/service/compile_service.h"
#include "runtime/diagnostic.h"
#include "runtime/kernel.h"
#include "runtime/program/program.h"

namespace nacre {

/// From a sliced recording to a kernel: every pass in order, then an engine.
/// Null, with a diagnostic, if the Program is too large or takes too many steps, or the
/// JIT refuses. `stages` may be null;
/// `service` may be null for the other backends.
std::shared_ptr<const Kernel> compile(Program program, const CompileOptions& options,
                                      CompileService* service, Diagnostics& diagnostics,
                                      std::vector<StageReport>* stages = nullptr);

/// Several, side by side on the service's threads; each as above. `stages`, if not
/// null, gets a list for each.
std::vector<std::shared_ptr<const Kernel>> compile_all(
    std::vector<Program> programs, const CompileOptions& options, CompileService* service,
    Diagnostics& diagnostics, std::vector<std::vector<StageReport>>* stages = nullptr);

/// What the options of the pipeline mean for LLVM; lanes 0 becomes the widest
/// that pays on this machine.
CodegenOptions codegen_options(const CompileOptions& options);

}  // namespace nacre
