#include "jit/llvm/target.h"

#include <fmt/format.h>
#include <llvm/ADT/StringMap.h>
#include <llvm/MC/MCSubtargetInfo.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/SubtargetFeature.h>

#include <mutex>
#include <utility>

namespace nacre {

namespace {

void initialize_llvm() {
  static std::once_flag once;
  std::call_once(once, [] {
    llvm::InitializeNativeTarget();
    llvm::InitializeNativeTargetAsmPrinter();
    llvm::InitializeNativeTargetAsmParser();
  });
}

llvm::CodeGenOptLevel level(Tier tier) {
  return tier == Tier::quick ? llvm::CodeGenOptLevel::None : llvm::CodeGenOptLevel::Default;
}

}  // namespace

Target Target::host() {
  static const Target found = [] {
    llvm::SubtargetFeatures features;
    for (const auto& feature : llvm::sys::getHostCPUFeatures()) {
      features.AddFeature(feature.getKey(), feature.getValue());
    }
    return Target{llvm::sys::getHostCPUName().str(), features.getString()};
  }();
  return found;
}

std::string CodegenOptions::key() const {
  return fmt::format("w{} {} tier{} cpu={} features={}", lanes, accuracy_name(accuracy),
                     static_cast<int>(tier), target.cpu, target.features);
}

int widest_lanes(const Target& target) {
  CodegenOptions options;
  options.target = target;
  std::string error;
  const auto machine = codegen::make_target_machine(options, error);
  if (machine == nullptr) return 4;
  const codegen::Features features = codegen::features_of(*machine);
  return features.avx512 ? 16 : features.avx ? 8 : 4;
}

namespace codegen {

std::unique_ptr<llvm::TargetMachine> make_target_machine(const CodegenOptions& options,
                                                         std::string& error) {
  initialize_llvm();
  const std::string triple = llvm::sys::getProcessTriple();
  const llvm::Target* target = llvm::TargetRegistry::lookupTarget(triple, error);
  if (target == nullptr) return nullptr;
  llvm::TargetOptions flags;
  // `fma` is an operation of ours; nothing else is to be contracted, unless an
  // instruction's own flags allow it.
  flags.AllowFPOpFusion = llvm::FPOpFusion::Standard;
  std::unique_ptr<llvm::TargetMachine> machine(target->createTargetMachine(
      triple, options.target.cpu, options.target.features, flags, llvm::Reloc::PIC_,
      llvm::CodeModel::Small, level(options.tier), /*JIT=*/true));
  if (machine == nullptr || !machine->getMCSubtargetInfo()->isCPUStringValid(options.target.cpu)) {
    error = fmt::format("unknown CPU '{}'", options.target.cpu);
    return nullptr;
  }
  return machine;
}

Features features_of(const llvm::TargetMachine& machine) {
  const llvm::MCSubtargetInfo& info = *machine.getMCSubtargetInfo();
  const auto has = [&](const char* feature) { return info.checkFeatures(feature); };
  return {.sse41 = has("+sse4.1"),
          .avx = has("+avx"),
          .avx2 = has("+avx2"),
          .fma = has("+fma"),
          .f16c = has("+f16c"),
          .avx512 = has("+avx512f") && has("+avx512bw") && has("+avx512dq") && has("+avx512vl")};
}

}  // namespace codegen
}  // namespace nacre
