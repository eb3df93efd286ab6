#include <llvm/ExecutionEngine/Orc/DebugObjectManagerPlugin.h>
#include <llvm/ExecutionEngine/Orc/Debugging/PerfSupportPlugin.h>
#include <llvm/ExecutionEngine/Orc/EPCDebugObjectRegistrar.h>
#include <llvm/ExecutionEngine/Orc/TargetProcess/JITLoaderGDB.h>
#include <llvm/ExecutionEngine/Orc/TargetProcess/JITLoaderPerf.h>

#include <memory>

#include "jit/llvm/orc.h"

namespace nacre {

namespace {

namespace orc = llvm::orc;

/// LLVM's side of the jitdump protocol, by the names that its plugin looks for.
orc::SymbolMap perf_functions(orc::ExecutionSession& session) {
  orc::SymbolMap symbols;
  const auto add = [&](const char* name, auto* function) {
    symbols[session.intern(name)] = {orc::ExecutorAddr::fromPtr(function),
                                     llvm::JITSymbolFlags::Exported};
  };
  add("llvm_orc_registerJITLoaderPerfStart", &llvm_orc_registerJITLoaderPerfStart);
  add("llvm_orc_registerJITLoaderPerfEnd", &llvm_orc_registerJITLoaderPerfEnd);
  add("llvm_orc_registerJITLoaderPerfImpl", &llvm_orc_registerJITLoaderPerfImpl);
  return symbols;
}

}  // namespace

llvm::Error add_observers(orc::ExecutionSession& session, orc::ObjectLinkingLayer& layer,
                          orc::JITDylib& functions, const SessionOptions& options) {
  if (options.debugger) {
    const auto address = orc::ExecutorAddr::fromPtr(&llvm_orc_registerJITLoaderGDBWrapper);
    layer.addPlugin(std::make_shared<orc::DebugObjectManagerPlugin>(
        session, std::make_unique<orc::EPCDebugObjectRegistrar>(session, address),
        /*RequireDebugSections=*/false, /*AutoRegisterCode=*/true));
  }
  if (options.perf) {
    if (auto failed = functions.define(orc::absoluteSymbols(perf_functions(session)))) {
      return failed;
    }
    auto plugin = orc::PerfSupportPlugin::Create(session.getExecutorProcessControl(), functions,
                                                 /*EmitDebugInfo=*/false, /*EmitUnwindInfo=*/false);
    if (!plugin) return plugin.takeError();
    layer.addPlugin(std::move(*plugin));
  }
  return llvm::Error::success();
}

}  // namespace nacre
