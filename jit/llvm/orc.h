#pragma once

// ORC's headers, for the .cpp files of this folder that load code.

#include <llvm/ExecutionEngine/Orc/Core.h>
#include <llvm/ExecutionEngine/Orc/ExecutorProcessControl.h>
#include <llvm/ExecutionEngine/Orc/ObjectLinkingLayer.h>
#include <llvm/ExecutionEngine/Orc/TaskDispatch.h>

#include "jit/llvm/session.h"

namespace nacre {

/// Adds the plugins that tell debugger and profiler about loaded code.
llvm::Error add_observers(llvm::orc::ExecutionSession& session,
                          llvm::orc::ObjectLinkingLayer& layer, llvm::orc::JITDylib& functions,
                          const SessionOptions& options);

}  // namespace nacre
