#include "jit/llvm/session.h"

#include <fmt/format.h>
#include <llvm/Support/MemoryBuffer.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>
#include <utility>

#include "jit/llvm/code_memory.h"
#include "jit/llvm/orc.h"
#include "runtime/process.h"

namespace nacre {

namespace {

namespace orc = llvm::orc;

template <class F>
orc::ExecutorSymbolDef function(F* pointer) {
  return {orc::ExecutorAddr::fromPtr(pointer),
          llvm::JITSymbolFlags::Exported | llvm::JITSymbolFlags::Callable};
}

/// What LLVM may call where the CPU has no instruction, and for large fills.
orc::SymbolMap library_functions(orc::ExecutionSession& session) {
  orc::SymbolMap symbols;
  symbols[session.intern("memset")] = function(&std::memset);
  symbols[session.intern("memcpy")] =
      function(static_cast<void* (*)(void*, const void*, std::size_t)>(&std::memcpy));
  symbols[session.intern("fmaf")] = function(&::fmaf);
  symbols[session.intern("floorf")] = function(&::floorf);
  symbols[session.intern("ceilf")] = function(&::ceilf);
  symbols[session.intern("truncf")] = function(&::truncf);
  // As Op::round wants it in the environment that kernels run in.
  symbols[session.intern("roundevenf")] = function(&::nearbyintf);
  return symbols;
}

/// Whether the system lets written memory become executable. Hardened ones don't
/// (SELinux without execmem, PR_SET_MDWE).
bool may_make_code() {
  const long page = sysconf(_SC_PAGESIZE);
  const auto size = static_cast<std::size_t>(page);
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return false;
  const bool may = mprotect(memory, size, PROT_READ | PROT_EXEC) == 0;
  munmap(memory, size);
  return may;
}

/// LLVM's linker and what it keeps.
struct Linker {
  explicit Linker(std::unique_ptr<orc::SelfExecutorProcessControl> control)
      : session(std::move(control)), layer(session, memory) {}

  orc::ExecutionSession session;
  CodeMemory memory;
  orc::ObjectLinkingLayer layer;
};

/// Of what an object has.
struct Addresses {
  orc::ExecutorAddr entry;
  orc::ExecutorAddr fits;  ///< 0: it has none.
};

/// The ORC session; handles share it, so it goes when the last of all goes.
class Core {
 public:
  static std::shared_ptr<Core> create(const SessionOptions& options, std::string& error) {
    if (!may_make_code()) {
      error = "the system refuses executable memory";
      return nullptr;
    }
    auto control = orc::SelfExecutorProcessControl::Create(
        nullptr, std::make_unique<orc::InPlaceTaskDispatcher>());
    if (!control) {
      error = llvm::toString(control.takeError());
      return nullptr;
    }
    auto core = shared_in_process(std::unique_ptr<Core>(new Core(std::move(*control))));
    if (llvm::Error failed = core->prepare(options)) {
      error = llvm::toString(std::move(failed));
      return nullptr;
    }
    return core;
  }

  ~Core() {
    if (is_broken_) {
      (void)linker_.release();
    } else {
      llvm::consumeError(linker_->session.endSession());
    }
  }

  orc::JITDylib* load(const ObjectCode& object, Addresses& at, std::string& error,
                      bool& no_memory) {
    if (!process_.is_this()) {
      error = "it is for the session of another process";
      return nullptr;
    }
    const std::scoped_lock lock(mutex_);
    if (is_broken_) {
      error = "memory was short while another was loaded";
      no_memory = true;
      return nullptr;
    }
    // LLVM's frames are left without a clean-up (see compile_object), its locks held.
    is_broken_ = true;
    orc::JITDylib* library = load_locked(object, at, error, no_memory);
    is_broken_ = false;
    return library;
  }

  void remove(orc::JITDylib& library) {
    if (keeps_code_ || !process_.is_this()) return;
    const std::scoped_lock lock(mutex_);
    if (!is_broken_) remove_locked(library);
  }

 private:
  explicit Core(std::unique_ptr<orc::SelfExecutorProcessControl> control)
      : linker_(std::make_unique<Linker>(std::move(control))) {
    // ORC prints by default. It reports on the thread that asked.
    linker_->session.setErrorReporter(
        [this](llvm::Error error) { reported_ += "; " + llvm::toString(std::move(error)); });
  }

  orc::JITDylib* load_locked(const ObjectCode& object, Addresses& at, std::string& error,
                             bool& no_memory) {
    orc::ExecutionSession& session = linker_->session;
    reported_.clear();
    orc::JITDylib& library = session.createBareJITDylib(fmt::format("kernel.{}", number_++));
    library.addToLinkOrder(*functions_);
    auto buffer = llvm::MemoryBuffer::getMemBufferCopy(
        llvm::StringRef(object.bytes.data(), object.bytes.size()), object.symbol);
    llvm::Error failed = linker_->layer.add(library, std::move(buffer));
    if (!failed) {
      const auto entry = session.intern(object.symbol);
      const auto fits = session.intern(fits_symbol(object.symbol));
      orc::SymbolLookupSet wanted(entry);
      wanted.add(fits, orc::SymbolLookupFlags::WeaklyReferencedSymbol);
      auto found = session.lookup(orc::makeJITDylibSearchOrder(&library), std::move(wanted));
      if (found) {
        at.entry = found->lookup(entry).getAddress();
        if (found->contains(fits)) at.fits = found->lookup(fits).getAddress();
        return &library;
      }
      failed = found.takeError();
    }
    error = llvm::toString(std::move(failed)) + reported_;
    no_memory = linker_->memory.has_run_out();
    remove_locked(library);
    return nullptr;
  }

  llvm::Error prepare(const SessionOptions& options) {
    keeps_code_ = options.debugger;
    orc::ExecutionSession& session = linker_->session;
    functions_ = &session.createBareJITDylib("functions");
    if (auto failed = functions_->define(orc::absoluteSymbols(library_functions(session)))) {
      return failed;
    }
    return add_observers(session, linker_->layer, *functions_, options);
  }

  void remove_locked(orc::JITDylib& library) {
    orc::ExecutionSession& session = linker_->session;
    llvm::consumeError(session.removeJITDylib(library));
    // Names are unique, so they would pile up.
    session.getSymbolStringPool()->clearDeadEntries();
  }

  // Loading and unloading take a tenth of a millisecond: one at a time.
  std::mutex mutex_;
  const Process process_;
  std::string reported_;
  std::uint64_t number_ = 0;
  bool keeps_code_ = false;
  std::unique_ptr<Linker> linker_;
  /// Memory ran out within LLVM: nothing is loaded or unloaded any more, and what was is
  /// left where it is.
  bool is_broken_ = false;
  orc::JITDylib* functions_ = nullptr;
};

class Loaded final : public LoadedCode {
 public:
  Loaded(std::shared_ptr<Core> core, orc::JITDylib& library, const Addresses& at)
      : core_(std::move(core)), library_(library), entry_(at.entry.toPtr<Entry>()) {
    if (at.fits.isNull()) return;
    std::uint64_t length = 0;
    std::memcpy(&length, at.fits.toPtr<const char*>(), sizeof length);
    fits_ = {at.fits.toPtr<const char*>() + sizeof length, static_cast<std::size_t>(length)};
  }
  ~Loaded() override { core_->remove(library_); }
  Entry entry() const override { return entry_; }
  std::string_view fits() const override { return fits_; }

 private:
  std::shared_ptr<Core> core_;
  orc::JITDylib& library_;
  Entry entry_;
  std::string_view fits_;
};

class Session final : public JitSession {
 public:
  explicit Session(std::shared_ptr<Core> core) : core_(std::move(core)) {}

  std::shared_ptr<const LoadedCode> load(const ObjectCode& object,
                                         Diagnostics& diagnostics) override {
    Addresses at;
    std::string error;
    bool no_memory = false;
    orc::JITDylib* library = core_->load(object, at, error, no_memory);
    if (library == nullptr && no_memory) {
      diagnostics.warning("code-memory", {}, "a kernel is interpreted: " + error, {},
                          object.symbol);
      return nullptr;
    }
    if (library == nullptr) {
      diagnostics.error("link", {}, "can't load a kernel: " + error, {}, object.symbol);
      return nullptr;
    }
    return std::make_shared<Loaded>(core_, *library, at);
  }

 private:
  std::shared_ptr<Core> core_;
};

}  // namespace

std::shared_ptr<JitSession> JitSession::create(const SessionOptions& options,
                                               Diagnostics& diagnostics) {
  std::string error;
  std::shared_ptr<Core> core = Core::create(options, error);
  if (core == nullptr) {
    diagnostics.error("jit-session", {}, "can't compile at run time: " + error);
    return nullptr;
  }
  return std::make_shared<Session>(std::move(core));
}

}  // namespace nacre
