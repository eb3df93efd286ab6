#pragma once

// Needs LLVM; for the .cpp files of this folder.

#include <llvm/ExecutionEngine/JITLink/JITLinkMemoryManager.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "jit/llvm/code_slab.h"

namespace nacre {

/// Gives linked kernels their pages out of slabs, so that thousands of kernels are a few
/// mappings of the process (Linux allows 65,530). No page is ever writable and executable.
class CodeMemory final : public llvm::jitlink::JITLinkMemoryManager {
 public:
  using JITLinkMemoryManager::allocate;
  using JITLinkMemoryManager::deallocate;
  void allocate(const llvm::jitlink::JITLinkDylib* library, llvm::jitlink::LinkGraph& graph,
                OnAllocatedFunction done) override;
  void deallocate(std::vector<FinalizedAlloc> kernels, OnDeallocatedFunction done) override;

  /// Whether the system has refused memory since it was last asked.
  bool has_run_out() { return ran_out_.exchange(false); }

 private:
  class InFlight;
  struct Kernel;

  CodePages take(std::size_t code, std::size_t data);
  bool protect(const CodePages& pages, CodeSlab::State state);
  void give_back(const CodePages& pages);

  std::mutex mutex_;
  std::vector<std::unique_ptr<CodeSlab>> slabs_;
  std::atomic<bool> ran_out_ = false;
};

}  // namespace nacre
