#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "jit/compile/compile.h"
#include "jit/document/document.h"
#include "jit/service/compile_service.h"
#include "jit/shading/shading_system.h"
#include "jit/tune/kernel_run.h"
#include "runtime/program/slice.h"

namespace nacre::bench {

/// The shading system that a benchmark program measures: the MaterialX library, no
/// cache on disk, one compiling thread. Ends the program where there is no library.
ShadingSystem& shading_system();

/// A compiler without a cache, for Programs that are no document's.
CompileService& compile_service();

/// A document of bench/documents, "chain.mtlx". Ends the program where it can't be read.
const Document& bench_document(const std::string& file);

/// Graph output of a document as a kernel.
std::unique_ptr<KernelRun> run_output(const Document& document, const std::string& output,
                                      const CompileOptions& options, std::string& error);

/// A recording of the caller's own, through the whole pipeline.
std::unique_ptr<KernelRun> run_recorded(const Program& recorded, std::string name,
                                        std::span<const SliceOutput> outputs,
                                        const CompileOptions& options, std::string& error,
                                        const Columns& given = {});

}  // namespace nacre::bench
