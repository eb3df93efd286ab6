#include "jit/llvm/target.h"

#include <fmt/format.h>
#include <llvm/ADT/StringMap.h>
#include <llvm/MC/MCSubtargetInfo.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/SubtargetFeature.h>

#include <algorithm>
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

/// Asked first, because LLVM prints about names that it does not know.
bool is_known(const llvm::Target& target, const std::string& triple, const Target& wanted,
              std::string& error) {
  const std::unique_ptr<llvm::MCSubtargetInfo> any(target.createMCSubtargetInfo(triple, "", ""));
  if (any == nullptr || !any->isCPUStringValid(wanted.cpu)) {
    error = fmt::format("unknown CPU '{}'", wanted.cpu);
    return false;
  }
  const llvm::SubtargetFeatures features(wanted.features);
  for (const std::string& feature : features.getFeatures()) {
    const llvm::StringRef name = llvm::StringRef(feature).drop_front();
    const bool known = std::ranges::any_of(any->getAllProcessorFeatures(),
                                           [&](const auto& each) { return name == each.Key; });
    if (known) continue;
    error = fmt::format("unknown CPU feature '{}'", feature);
    return false;
  }
  return true;
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
  if (target == nullptr || !is_known(*target, triple, options.target, error)) return nullptr;
  llvm::TargetOptions flags;
  // `fma` is an operation of ours; nothing else is to be contracted, unless an
  // instruction's own flags allow it.
  flags.AllowFPOpFusion = llvm::FPOpFusion::Standard;
  std::unique_ptr<llvm::TargetMachine> machine(target->createTargetMachine(
      triple, options.target.cpu, options.target.features, flags, llvm::Reloc::PIC_,
      llvm::CodeModel::Small, level(options.tier), /*JIT=*/true));
  if (machine == nullptr) {
    error = "no code can be made for this machine";
    return nullptr;
  }
  return machine;
}

Features features_of(const llvm::TargetMachine& machine) {
  const llvm::MCSubtargetInfo& info = *machine.getMCSubtargetInfo();
  const auto has = [&](const char* feature) { return info.checkFeatures(feature); };
  return {.avx = has("+avx"),
          .avx2 = has("+avx2"),
          .f16c = has("+f16c"),
          .avx512 = has("+avx512f") && has("+avx512bw") && has("+avx512dq") && has("+avx512vl")};
}

}  // namespace codegen
}  // namespace nacre
