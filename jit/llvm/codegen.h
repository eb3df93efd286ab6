#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jit/llvm/options.h"
#include "runtime/diagnostic.h"
#include "runtime/program/program.h"

namespace nacre {

/// Where the time of making one kernel went, in seconds, and how large it is.
struct CompileStats {
  double emit = 0;      ///< Program to LLVM IR.
  double optimize = 0;  ///< LLVM's passes.
  double codegen = 0;   ///< LLVM IR to machine code.
  double link = 0;      ///< Machine code into memory.
  double cache = 0;     ///< Reading or writing the cache on disk.
  bool from_cache = false;
  std::size_t object_bytes = 0;

  double total() const { return emit + optimize + codegen + link + cache; }
};

/// Relocatable machine code of one Program: an ELF object without addresses of
/// this process, so it may be kept on disk.
struct ObjectCode {
  std::string symbol;     ///< The entry, `void(const KernelArguments*)`; see run_code().
  std::string interface;  ///< interface_text() of the Program: what it may be bound to.
  std::vector<char> bytes;
};

/// Of the name of an entry, that of the length of its Program's fits_to_bytes() and of what
/// follows: where there are any.
std::string fits_symbol(const std::string& entry);

/// The entry's name: "nacre_<start of the Program's code_digest()>_<name>_w16".
std::string entry_symbol(const Program& program, const CodegenOptions& options);

/// The way in which code is made and wants to be called: equal in a library and in a process
/// that compiles for it.
std::string code_version();

/// Everything that decides what compile_object() gives, as text: the Program's
/// code_digest(), the options, this build of Nacre and the LLVM it runs with; `then`: what is
/// done to the Program before. Objects may stand for each other if and only if their keys are
/// equal.
std::string code_key(const Program& program, const CodegenOptions& options,
                     std::string_view then = {});

/// Compiles on the calling thread, which needs a stack of 8 MiB for large
/// programs. The Program is verified, its varying values are marked, and
/// transcendental operations, keep and ddx are gone (asserted). Nothing, with
/// an error "codegen" in `diagnostics`, if the target is unknown or LLVM fails;
/// nothing also if `cancelled`, which is asked between the stages, says so.
std::optional<ObjectCode> compile_object(const Program& program, const CodegenOptions& options,
                                         Diagnostics& diagnostics, CompileStats* stats = nullptr,
                                         const std::function<bool()>& cancelled = {});

/// The text that LLVM has after its passes; empty on failure.
std::string dump_ir(const Program& program, const CodegenOptions& options,
                    Diagnostics& diagnostics);
/// The machine code as assembly; empty on failure.
std::string dump_assembly(const Program& program, const CodegenOptions& options,
                          Diagnostics& diagnostics);

}  // namespace nacre
