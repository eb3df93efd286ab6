#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "jit/compile/facts.h"
#include "runtime/kernel.h"
#include "runtime/program/cost.h"
#include "runtime/stop.h"

namespace nacre {

/// What runs a Program.
enum class Backend : std::uint8_t {
  jit,          ///< Machine code through LLVM.
  interpreter,  ///< Ready at once; the same bits.
  reference,    ///< Double precision, slow: the oracle.
};

/// How a Program becomes a kernel, and what that may cost.
struct CompileOptions {
  Accuracy accuracy = Accuracy::standard;  ///< Of the transcendental functions and closures.
  Backend backend = Backend::jit;          ///< What runs the kernel.
  /// How far tables may be off that stand for what depends on one bounded number alone, relative
  /// to it or to a hundredth of its largest (see tabulate()); 0: there are none. Not of the
  /// reference engine. Nothing: what the accuracy is worth, table_error_of().
  std::optional<double> table_error = std::nullopt;
  /// Of which slots somebody gives the kernels what is fitted to their values (ParameterFits,
  /// KernelArguments::fitted): what depends on them and one bounded number is read there, four
  /// times as far off as tables are. Null: of none. Not of the reference engine.
  std::function<bool(std::string_view slot)> fits_slot = {};
  /// What is known of what kernels read: they leave out what cannot happen then, and have the same
  /// bits. Points of which it is not true are computed as if nothing had been said. Not of the
  /// reference engine.
  std::vector<Fact> facts = {};
  /// 1, 4, 8, 16; 0: the widest that pays on this machine; else an error. JIT only.
  int lanes = 0;
  /// Code of one lane as well, which runs of one point take. JIT only.
  bool single_points = false;
  /// Treat every value as varying: slower, and must change no result.
  bool all_varying = false;
  /// Answer through the interpreter while the JIT compiles in the background.
  bool asynchronous = false;
  int priority = 0;  ///< Of that: higher ones are compiled first.
  /// A Program with more instructions, before or after any stage, is refused.
  std::size_t max_instructions = 500'000;
  /// Steps that a pass of points may take. A Program that takes more whatever its loops do
  /// is refused; a run that does ends as RunStatus::too_many_steps. See runtime/program/cost.h.
  std::uint64_t max_steps = default_max_steps;
  /// Seconds from a call that compiles to its return, for everything it does. Spent
  /// before there is a Program for each kernel, which has a second at least, that is an
  /// error; spent waiting for the JIT, the kernel is interpreted, with a warning, and the
  /// thread that compiles goes on to the end of LLVM's stage.
  double max_seconds = 60;
  /// Ends a call early; a deadline of it counts as `max_seconds` does.
  Stop stop = {};
  /// Go through every stage even where the code is there already, so that StageReports and
  /// Kernel::program() say what the code was made of.
  bool whole = false;
  bool keep_text = false;      ///< Fill StageReport::text with the Program.
  bool dump_ir = false;        ///< A stage "llvm" with the LLVM IR as text. JIT only.
  bool dump_assembly = false;  ///< A stage "assembly" with the machine code as text. JIT only.
};

/// Of each slot whether what depends on it is fitted; empty where nothing is.
std::vector<bool> fitted_slots(const Program& program, const CompileOptions& options);

/// CompileOptions::table_error, by accuracy where nothing is said.
double table_error_of(const CompileOptions& options);

/// When a call that begins now must have made its Programs, for `stop`.
Stop stop_from_now(const CompileOptions& options);

}  // namespace nacre
