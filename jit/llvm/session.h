#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "jit/llvm/codegen.h"
#include "runtime/diagnostic.h"
#include "runtime/kernel.h"
#include "runtime/program/cost.h"

namespace nacre {

/// Who is told about the code that is loaded.
struct SessionOptions {
  /// GDB, through its JIT interface. Code then stays in memory until the session
  /// ends, because LLVM 19 does not tell the debugger when it goes.
  bool debugger = false;
  bool perf = false;  ///< Linux perf, through a jitdump file in ~/.debug/jit.
};

struct RunState;

/// Machine code in memory. It stays there while a handle to it is held.
class LoadedCode {
 public:
  using Entry = void (*)(RunState*);

  virtual ~LoadedCode() = default;
  /// For whole batches, in the caller's floating-point environment: run it by
  /// run_code() or make a kernel of it.
  virtual Entry entry() const = 0;
  /// fits_to_bytes() of the Program.
  virtual std::string_view fits() const = 0;
};

/// Holds the code that this process compiled or read from a cache. Pages are
/// either writable or executable, never both. Any thread may use it, and handles
/// may outlive it.
class JitSession {
 public:
  /// Null, with an error "jit-session" in `diagnostics`, where the system does
  /// not let a process make executable memory.
  static std::shared_ptr<JitSession> create(const SessionOptions& options,
                                            Diagnostics& diagnostics);
  virtual ~JitSession() = default;

  /// Links an object into memory. Null, with an error "link" in `diagnostics`, if it is
  /// not a sound object; with a warning "code-memory", if the system has no memory for it.
  /// A child of fork() makes a session of its own: here it gets an error "link".
  virtual std::shared_ptr<const LoadedCode> load(const ObjectCode& object,
                                                 Diagnostics& diagnostics) = 0;
};

/// A Kernel of that code; `lanes` and `max_steps` as in the options it was compiled with.
std::shared_ptr<const Kernel> make_jit_kernel(Program program,
                                              std::shared_ptr<const LoadedCode> code, int lanes,
                                              std::uint64_t max_steps = default_max_steps);

}  // namespace nacre
