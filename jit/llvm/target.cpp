#include "jit/llvm/target.h"

#include <fmt/format.h>
#include <llvm/ADT/StringMap.h>
#include <llvm/Analysis/TargetLibraryInfo.h>
#include <llvm/MC/MCSubtargetInfo.h>
#include <llvm/MC/TargetRegistry.h>
#include <llvm/Support/ErrorHandling.h>
#include <llvm/Support/TargetSelect.h>
#include <llvm/TargetParser/Host.h>
#include <llvm/TargetParser/SubtargetFeature.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <mutex>
#include <new>
#include <utility>

namespace nacre {

namespace {

/// Throws what operator new throws, through LLVM to whoever asked for the compile.
void out_of_memory(void* /*user*/, const char* /*reason*/, bool /*crash_dump*/) {
  throw std::bad_alloc();
}

void initialize_llvm() {
  static std::once_flag once;
  std::call_once(once, [] {
    llvm::InitializeNativeTarget();
    llvm::InitializeNativeTargetAsmPrinter();
    llvm::InitializeNativeTargetAsmParser();
    // Else LLVM aborts where its own containers find no memory.
    llvm::install_bad_alloc_error_handler(out_of_memory, nullptr);
    // Names of library functions, which LLVM else sorts when the first kernel calls one: when the
    // process ends they must outlive that (runtime/process_end.h).
    llvm::LibFunc ignored;
    (void)llvm::TargetLibraryInfoImpl(llvm::Triple(llvm::sys::getProcessTriple()))
        .getLibFunc("memset", ignored);
  });
}

llvm::CodeGenOptLevel level(Tier tier) {
  return tier == Tier::quick ? llvm::CodeGenOptLevel::None : llvm::CodeGenOptLevel::Default;
}

/// LLVM's word for CPUs whose gathers are quick: nothing that a CPU says of itself.
constexpr std::string_view tuning_for_gathers = "fast-gather";

/// Of this machine.
bool may_gather() {
  std::ifstream file("/sys/devices/system/cpu/vulnerabilities/gather_data_sampling");
  std::string line;
  std::getline(file, line);
  return codegen::gathers_are_not_slowed(line);
}

/// What the emitter and LLVM's selection gain from, sorted. Nothing else of a CPU is
/// used, because LLVM takes what it is given: with avx512fp16 it keeps masks as halves
/// and then has no instruction for that ("Cannot select: f16 = bitcast v16i1").
constexpr std::array<std::string_view, 20> useful{
    "avx",   "avx2",   "avx512bw", "avx512cd", "avx512dq",         "avx512f", "avx512vl",
    "bmi",   "bmi2",   "evex512",  "f16c",     tuning_for_gathers, "fma",     "lzcnt",
    "movbe", "popcnt", "sse3",     "sse4.1",   "sse4.2",           "ssse3"};
static_assert(std::ranges::is_sorted(useful));

/// AVX-512 counts as a whole, at its full width, or not at all: the first CPUs had some
/// of it only, the last may have it for 256 bits only.
bool is_avx512(std::string_view feature) {
  return feature.starts_with("avx512") || feature == "evex512";
}

/// The useful ones of a CPU as LLVM writes them, "+avx,+avx2". What CPUs without a name
/// have (x86-64) goes without saying.
std::string useful_features(const llvm::MCSubtargetInfo& info) {
  std::vector<std::string_view> found;
  for (const llvm::SubtargetFeatureKV& feature : info.getAllProcessorFeatures()) {
    if (!info.getFeatureBits()[feature.Value]) continue;
    if (std::ranges::binary_search(useful, feature.Key)) found.push_back(feature.Key);
  }
  if (std::ranges::count_if(found, is_avx512) != std::ranges::count_if(useful, is_avx512)) {
    std::erase_if(found, is_avx512);
  }
  std::string text;
  for (const std::string_view feature : found) {
    text += text.empty() ? "+" : ",+";
    text += feature;
  }
  return text;
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
    // Where the system hides a feature (virtual machines do), the CPU's name would turn
    // it on again: so each is named.
    const llvm::StringMap<bool> all = llvm::sys::getHostCPUFeatures();
    llvm::SubtargetFeatures features;
    for (const std::string_view name : useful) {
      if (name != tuning_for_gathers) features.AddFeature(name, all.lookup(name));
    }
    if (!may_gather()) features.AddFeature(tuning_for_gathers, false);
    return Target{llvm::sys::getHostCPUName().str(), features.getString()};
  }();
  return found;
}

std::string CodegenOptions::key() const {
  return fmt::format("w{} {} tier{} parts={}/{}{} cpu={} features={}", lanes,
                     accuracy_name(accuracy), static_cast<int>(tier), part, uncut,
                     line_tables ? " lines" : "", target.cpu, target.features);
}

namespace {

int lanes_of(const Target& target) {
  CodegenOptions options;
  options.target = target;
  std::string error;
  const auto machine = codegen::make_target_machine(options, error);
  if (machine == nullptr) return 4;
  const codegen::Features features = codegen::features_of(*machine);
  return features.avx512 ? 16 : features.avx ? 8 : 4;
}

}  // namespace

int widest_lanes(const Target& target) {
  if (target != Target::host()) return lanes_of(target);
  static const int found = lanes_of(Target::host());  // Asked for each compile.
  return found;
}

namespace codegen {

std::unique_ptr<llvm::TargetMachine> make_target_machine(const CodegenOptions& options,
                                                         std::string& error) {
  initialize_llvm();
  const std::string triple = llvm::sys::getProcessTriple();
  const llvm::Target* target = llvm::TargetRegistry::lookupTarget(triple, error);
  if (target == nullptr || !is_known(*target, triple, options.target, error)) return nullptr;
  const std::unique_ptr<llvm::MCSubtargetInfo> wanted(
      target->createMCSubtargetInfo(triple, options.target.cpu, options.target.features));
  llvm::TargetOptions flags;
  // `fma` is an operation of ours; nothing else is to be contracted, unless an
  // instruction's own flags allow it.
  flags.AllowFPOpFusion = llvm::FPOpFusion::Standard;
  std::unique_ptr<llvm::TargetMachine> machine(target->createTargetMachine(
      triple, baseline_cpu, useful_features(*wanted), flags, llvm::Reloc::PIC_,
      llvm::CodeModel::Small, level(options.tier), /*JIT=*/true));
  if (machine == nullptr) {
    error = "no code can be made for this machine";
    return nullptr;
  }
  return machine;
}

bool gathers_are_not_slowed(std::string_view linux_says) {
  return linux_says.starts_with("Not affected") || linux_says.starts_with("Vulnerable");
}

Features features_of(const llvm::TargetMachine& machine) {
  const llvm::MCSubtargetInfo& info = *machine.getMCSubtargetInfo();
  const auto has = [&](const char* feature) { return info.checkFeatures(feature); };
  const bool avx512 = has("+avx512f");
  return {.avx = has("+avx"),
          .avx2 = has("+avx2"),
          .f16c = has("+f16c"),
          .avx512 = avx512,
          .fast_gather = avx512 && has("+fast-gather"),
          .all = machine.getTargetFeatureString().str()};
}

}  // namespace codegen
}  // namespace nacre
