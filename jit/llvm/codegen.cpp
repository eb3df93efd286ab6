#include "jit/llvm/codegen.h"

#include <fmt/format.h>
#include <llvm/CodeGen/MachineModuleInfo.h>
#include <llvm/CodeGen/Passes.h>
#include <llvm/CodeGen/TargetPassConfig.h>
#include <llvm/IR/DiagnosticHandler.h>
#include <llvm/IR/DiagnosticInfo.h>
#include <llvm/IR/DiagnosticPrinter.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/IR/PassManager.h>
#include <llvm/IR/Verifier.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <utility>

#include "jit/llvm/module_emitter.h"
#include "jit/llvm/optimize.h"
#include "jit/llvm/target.h"
#include "runtime/float_environment.h"
#include "runtime/program/digest.h"
#include "runtime/program/serialize.h"

namespace nacre {

namespace {

/// Seconds since it was made or last asked.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = now - last_;
    last_ = now;
    return passed.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// LLVM says what is wrong to its context; the default would print and exit.
struct CollectDiagnostics final : llvm::DiagnosticHandler {
  explicit CollectDiagnostics(std::string& into) : errors(into) {}
  bool handleDiagnostics(const llvm::DiagnosticInfo& info) override {
    if (info.getSeverity() == llvm::DS_Error) {
      llvm::raw_string_ostream stream(errors);
      llvm::DiagnosticPrinterRawOStream printer(stream);
      info.print(printer);
      stream << '\n';
    }
    return true;
  }
  std::string& errors;
};

[[maybe_unused]] bool compilable(const Program& program) {
  for (const Function& function : program.functions) {
    for (const Instruction& instruction : function.code) {
      const Op op = instruction.op;
      const bool is_mark = op == Op::keep || op == Op::ddx || op == Op::stand_in;
      if (is_transcendental(op) || is_mark) return false;
    }
  }
  return verify(program).empty();
}

/// What LLVM works on: a context for each compile, so that they run side by side.
struct Work {
  std::string error;
  llvm::LLVMContext context;
  std::unique_ptr<llvm::TargetMachine> machine;
  std::unique_ptr<llvm::Module> module;
  llvm::FunctionAnalysisManager analyses;
  std::unique_ptr<llvm::legacy::PassManager> passes;  ///< While they run.
};

/// One compile.
class Job {
 public:
  Job(const Program& program, const CodegenOptions& options, CompileStats& stats)
      : program_(program), options_(options), stats_(stats) {
    work_->context.setDiagnosticHandler(std::make_unique<CollectDiagnostics>(work_->error));
  }

  /// Where memory runs out in LLVM the exception leaves its frames without a clean-up, for
  /// it is compiled without exceptions: its objects are as they were in the middle of
  /// something, and must not be looked at again, not even to free them.
  ~Job() {
    if (std::uncaught_exceptions() > exceptions_) (void)work_.release();
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  bool make_ir() {
    assert(compilable(program_));
    if (!is_lane_count(options_.lanes)) {
      work_->error = fmt::format("{} lanes; 1, 4, 8 or 16 are possible", options_.lanes);
      return false;
    }
    work_->machine = codegen::make_target_machine(options_, work_->error);
    if (work_->machine == nullptr) return false;
    Stopwatch clock;
    work_->module = std::make_unique<llvm::Module>("nacre", work_->context);
    work_->module->setTargetTriple(work_->machine->getTargetTriple().str());
    work_->module->setDataLayout(work_->machine->createDataLayout());
    const codegen::Features features = codegen::features_of(*work_->machine);
    symbol_ = entry_symbol(program_, options_);
    codegen::ModuleEmitter(program_, options_, features, *work_->module).emit(symbol_);
    add_fits();
    stats_.emit = clock.lap();
    assert(is_valid());
    return true;
  }

  void optimize() {
    Stopwatch clock;
    codegen::optimize(*work_->module, *work_->machine, options_.tier, work_->analyses);
    stats_.optimize = clock.lap();
  }

  const std::string& symbol() const { return symbol_; }

  std::string ir() const {
    std::string text;
    llvm::raw_string_ostream stream(text);
    work_->module->print(stream, nullptr);
    return stream.str();
  }

  bool generate(llvm::CodeGenFileType type, llvm::SmallVectorImpl<char>& bytes) {
    Stopwatch clock;
    llvm::raw_svector_ostream stream(bytes);
    work_->passes = std::make_unique<llvm::legacy::PassManager>();
    if (!add_passes(*work_->passes, stream, type)) {
      work_->error = "the target can't emit code";
      return false;
    }
    // LLVM 19's FastISel copies scalar b1 into mask registers by instructions that
    // do not exist ("Cannot emit physreg copy instruction"), and leaves vectors to
    // the other selector anyway. Adding the passes has switched it on.
    work_->machine->setFastISel(false);
    work_->passes->run(*work_->module);
    work_->passes.reset();  // They know the stream.
    stats_.codegen = clock.lap();
    return work_->error.empty();
  }

  void report(Diagnostics& diagnostics) const {
    diagnostics.error("codegen", {}, "can't compile a kernel: " + work_->error, {}, program_.name);
  }

 private:
  /// What TargetMachine::addPassesToEmitFile adds, but for scheduling after register
  /// allocation: a twelfth of the time, and no gain on a CPU that reorders.
  bool add_passes(llvm::legacy::PassManager& passes, llvm::raw_pwrite_stream& stream,
                  llvm::CodeGenFileType type) {
    auto& machine = static_cast<llvm::LLVMTargetMachine&>(*work_->machine);
    llvm::TargetPassConfig* config = machine.createPassConfig(passes);
    config->setDisableVerify(true);
    config->disablePass(&llvm::PostRASchedulerID);
    passes.add(config);
    auto* functions = new llvm::MachineModuleInfoWrapperPass(&machine);
    passes.add(functions);
    if (config->addISelPasses()) return false;
    config->addMachinePasses();
    config->setInitialized();
    llvm::MCContext& context = functions->getMMI().getContext();
    if (machine.addAsmPrinter(passes, stream, nullptr, type, context)) return false;
    passes.add(llvm::createFreeMachineFunctionPass());
    return true;
  }

  /// For who finds the code in a cache, and not the Program that it was made of.
  void add_fits() {
    const std::string bytes = fits_to_bytes(program_);
    if (bytes.empty()) return;
    const std::uint64_t length = bytes.size();
    std::string all(sizeof length, '\0');
    std::memcpy(all.data(), &length, sizeof length);
    all += bytes;
    auto* data = llvm::ConstantDataArray::getString(work_->context, all, /*AddNull=*/false);
    auto* symbol =
        new llvm::GlobalVariable(*work_->module, data->getType(), /*isConstant=*/true,
                                 llvm::GlobalValue::ExternalLinkage, data, fits_symbol(symbol_));
    symbol->setAlignment(llvm::Align(sizeof length));
  }

  bool is_valid() {
    llvm::raw_string_ostream stream(work_->error);
    return !llvm::verifyModule(*work_->module, &stream);
  }

  const Program& program_;
  const CodegenOptions& options_;
  CompileStats& stats_;
  const ScopedDefaultFloatEnvironment environment_;  ///< LLVM folds constants too.
  std::string symbol_;
  std::unique_ptr<Work> work_ = std::make_unique<Work>();
  const int exceptions_ = std::uncaught_exceptions();
};

}  // namespace

std::string fits_symbol(const std::string& entry) { return entry + "_fits"; }

std::string entry_symbol(const Program& program, const CodegenOptions& options) {
  const std::string digits = to_hex(code_digest(program)).substr(0, 32);
  std::string name = program.name;
  std::ranges::replace_if(name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return fmt::format("nacre_{}_{}_w{}", digits, name, options.lanes);
}

std::optional<ObjectCode> compile_object(const Program& program, const CodegenOptions& options,
                                         Diagnostics& diagnostics, CompileStats* stats,
                                         const std::function<bool()>& cancelled) {
  CompileStats own;
  Job job(program, options, stats != nullptr ? *stats : own);
  const auto stop = [&] { return cancelled && cancelled(); };
  llvm::SmallVector<char, 0> bytes;
  bool done = job.make_ir();
  if (done && stop()) return std::nullopt;
  if (done) job.optimize();
  if (done && stop()) return std::nullopt;
  done = done && job.generate(llvm::CodeGenFileType::ObjectFile, bytes);
  if (!done) {
    job.report(diagnostics);
    return std::nullopt;
  }
  if (stats != nullptr) stats->object_bytes = bytes.size();
  return ObjectCode{job.symbol(), interface_text(program), {bytes.begin(), bytes.end()}};
}

std::string dump_ir(const Program& program, const CodegenOptions& options,
                    Diagnostics& diagnostics) {
  CompileStats stats;
  Job job(program, options, stats);
  if (!job.make_ir()) {
    job.report(diagnostics);
    return {};
  }
  job.optimize();
  return job.ir();
}

std::string dump_assembly(const Program& program, const CodegenOptions& options,
                          Diagnostics& diagnostics) {
  CompileStats stats;
  Job job(program, options, stats);
  llvm::SmallVector<char, 0> text;
  bool done = job.make_ir();
  if (done) job.optimize();
  done = done && job.generate(llvm::CodeGenFileType::AssemblyFile, text);
  if (done) return {text.begin(), text.end()};
  job.report(diagnostics);
  return {};
}

}  // namespace nacre
