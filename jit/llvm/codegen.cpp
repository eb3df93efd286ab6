#include "jit/llvm/codegen.h"

#include <fmt/format.h>
#include <llvm/CodeGen/MachineModuleInfo.h>
#include <llvm/CodeGen/Passes.h>
#include <llvm/CodeGen/TargetPassConfig.h>
#include <llvm/IR/DiagnosticHandler.h>
#include <llvm/IR/DiagnosticInfo.h>
#include <llvm/IR/DiagnosticPrinter.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/IR/Verifier.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <chrono>
#include <memory>
#include <utility>

#include "jit/llvm/module_emitter.h"
#include "jit/llvm/optimize.h"
#include "jit/llvm/target.h"
#include "runtime/float_environment.h"
#include "runtime/program/digest.h"

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
      if (is_transcendental(op) || op == Op::keep || op == Op::ddx) return false;
    }
  }
  return verify(program).empty();
}

/// One compile: a context of its own, so that compiles run side by side.
class Job {
 public:
  Job(const Program& program, const CodegenOptions& options, CompileStats& stats)
      : program_(program), options_(options), stats_(stats) {
    context_.setDiagnosticHandler(std::make_unique<CollectDiagnostics>(error_));
  }

  bool make_ir() {
    assert(compilable(program_));
    if (!is_lane_count(options_.lanes)) {
      error_ = fmt::format("{} lanes; 1, 4, 8 or 16 are possible", options_.lanes);
      return false;
    }
    machine_ = codegen::make_target_machine(options_, error_);
    if (machine_ == nullptr) return false;
    Stopwatch clock;
    module_ = std::make_unique<llvm::Module>("nacre", context_);
    module_->setTargetTriple(machine_->getTargetTriple().str());
    module_->setDataLayout(machine_->createDataLayout());
    const codegen::Features features = codegen::features_of(*machine_);
    symbol_ = entry_symbol(program_, options_);
    codegen::ModuleEmitter(program_, options_, features, *module_).emit(symbol_);
    stats_.emit = clock.lap();
    assert(is_valid());
    return true;
  }

  void optimize() {
    Stopwatch clock;
    codegen::optimize(*module_, *machine_, options_.tier);
    stats_.optimize = clock.lap();
  }

  const std::string& symbol() const { return symbol_; }

  std::string ir() const {
    std::string text;
    llvm::raw_string_ostream stream(text);
    module_->print(stream, nullptr);
    return stream.str();
  }

  bool generate(llvm::CodeGenFileType type, llvm::SmallVectorImpl<char>& bytes) {
    Stopwatch clock;
    llvm::raw_svector_ostream stream(bytes);
    llvm::legacy::PassManager passes;
    if (!add_passes(passes, stream, type)) {
      error_ = "the target can't emit code";
      return false;
    }
    // LLVM 19's FastISel copies scalar b1 into mask registers by instructions that
    // do not exist ("Cannot emit physreg copy instruction"), and leaves vectors to
    // the other selector anyway. Adding the passes has switched it on.
    machine_->setFastISel(false);
    passes.run(*module_);
    stats_.codegen = clock.lap();
    return error_.empty();
  }

  void report(Diagnostics& diagnostics) const {
    diagnostics.error("codegen", {}, "can't compile a kernel: " + error_, {}, program_.name);
  }

 private:
  /// What TargetMachine::addPassesToEmitFile adds, but for scheduling after register
  /// allocation: a twelfth of the time, and no gain on a CPU that reorders.
  bool add_passes(llvm::legacy::PassManager& passes, llvm::raw_pwrite_stream& stream,
                  llvm::CodeGenFileType type) {
    auto& machine = static_cast<llvm::LLVMTargetMachine&>(*machine_);
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

  bool is_valid() {
    llvm::raw_string_ostream stream(error_);
    return !llvm::verifyModule(*module_, &stream);
  }

  const Program& program_;
  const CodegenOptions& options_;
  CompileStats& stats_;
  const ScopedDefaultFloatEnvironment environment_;  ///< LLVM folds constants too.
  std::string error_;
  std::string symbol_;
  llvm::LLVMContext context_;
  std::unique_ptr<llvm::TargetMachine> machine_;
  std::unique_ptr<llvm::Module> module_;
};

}  // namespace

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
