#include "jit/llvm/code_memory.h"

#include <llvm/ExecutionEngine/JITLink/JITLink.h>

#include <algorithm>
#include <utility>

namespace nacre {

namespace {

namespace orc = llvm::orc;

llvm::Error fault(const char* text) {
  return llvm::make_error<llvm::StringError>(text, llvm::inconvertibleErrorCode());
}

bool has(const orc::AllocGroup& group, orc::MemProt protection) {
  return (static_cast<unsigned>(group.getMemProt()) & static_cast<unsigned>(protection)) != 0;
}

bool is_code(const orc::AllocGroup& group) { return has(group, orc::MemProt::Exec); }

}  // namespace

/// What stays of a linked kernel.
struct CodeMemory::Kernel {
  CodePages pages;
  std::vector<orc::shared::WrapperFunctionCall> at_end;
};

/// A kernel whose pages are being written.
class CodeMemory::InFlight final : public JITLinkMemoryManager::InFlightAlloc {
 public:
  InFlight(CodeMemory& memory, llvm::jitlink::LinkGraph& graph, const CodePages& pages)
      : memory_(memory), graph_(graph), pages_(pages) {}

  void finalize(OnFinalizedFunction done) override {
    if (!memory_.protect(pages_, CodeSlab::State::finished)) {
      return done(fault("the system refuses executable memory"));
    }
    auto at_end = orc::shared::runFinalizeActions(graph_.allocActions());
    if (!at_end) {
      memory_.give_back(pages_);
      return done(at_end.takeError());
    }
    auto* kernel = new Kernel{pages_, std::move(*at_end)};
    done(FinalizedAlloc(orc::ExecutorAddr::fromPtr(kernel)));
  }

  void abandon(OnAbandonedFunction done) override {
    if (memory_.protect(pages_, CodeSlab::State::finished)) memory_.give_back(pages_);
    done(llvm::Error::success());
  }

 private:
  CodeMemory& memory_;
  llvm::jitlink::LinkGraph& graph_;
  CodePages pages_;
};

void CodeMemory::allocate(const llvm::jitlink::JITLinkDylib*, llvm::jitlink::LinkGraph& graph,
                          OnAllocatedFunction done) {
  llvm::jitlink::BasicLayout layout(graph);
  const std::size_t page = CodeSlab::page_size();
  const auto pages_of = [page](const auto& segment) {
    return static_cast<std::size_t>((segment.ContentSize + segment.ZeroFillSize + page - 1) / page);
  };
  std::size_t code = 0;
  std::size_t data = 0;
  for (auto& [group, segment] : layout.segments()) {
    if (has(group, orc::MemProt::Write) || segment.Alignment.value() > page) {
      return done(fault("it is no code of a kernel"));
    }
    (is_code(group) ? code : data) += pages_of(segment);
  }
  const CodePages pages = take(code, data);
  if (pages.slab == nullptr) return done(fault("the system has no more memory for code"));
  char* next_code = pages.code;
  char* next_data = pages.data;
  for (auto& [group, segment] : layout.segments()) {
    char*& next = is_code(group) ? next_code : next_data;
    segment.WorkingMem = next;
    segment.Addr = orc::ExecutorAddr::fromPtr(next);
    next += pages_of(segment) * page;
  }
  if (llvm::Error failed = layout.apply()) {
    if (protect(pages, CodeSlab::State::finished)) give_back(pages);
    return done(std::move(failed));
  }
  done(std::make_unique<InFlight>(*this, graph, pages));
}

void CodeMemory::deallocate(std::vector<FinalizedAlloc> kernels, OnDeallocatedFunction done) {
  llvm::Error faults = llvm::Error::success();
  while (!kernels.empty()) {
    const std::unique_ptr<Kernel> kernel(kernels.back().release().toPtr<Kernel*>());
    kernels.pop_back();
    faults = llvm::joinErrors(std::move(faults), orc::shared::runDeallocActions(kernel->at_end));
    give_back(kernel->pages);
  }
  done(std::move(faults));
}

CodePages CodeMemory::take(std::size_t code, std::size_t data) {
  const std::scoped_lock lock(mutex_);
  CodePages pages;
  // The latest slab has room more often than the others.
  for (std::size_t i = slabs_.size(); i-- > 0;) {
    if (slabs_[i]->take(code, data, pages)) break;
  }
  if (pages.slab == nullptr) {
    std::unique_ptr<CodeSlab> made = CodeSlab::create(code + data);
    if (made != nullptr && made->take(code, data, pages)) slabs_.push_back(std::move(made));
  }
  if (pages.slab != nullptr && pages.slab->protect(pages, CodeSlab::State::writable)) return pages;
  // What could not be made writable stays taken: its state is not known.
  ran_out_ = true;
  return {};
}

bool CodeMemory::protect(const CodePages& pages, CodeSlab::State state) {
  const std::scoped_lock lock(mutex_);
  if (pages.slab->protect(pages, state)) return true;
  ran_out_ = true;
  return false;
}

void CodeMemory::give_back(const CodePages& pages) {
  const std::scoped_lock lock(mutex_);
  pages.slab->give_back(pages);
  if (!pages.slab->is_unused() || slabs_.size() == 1) return;
  std::erase_if(slabs_, [&](const auto& slab) { return slab.get() == pages.slab; });
}

}  // namespace nacre
