#include "runtime/texture/aligned_words.h"

#include <algorithm>
#include <new>
#include <utility>

namespace nacre {

namespace {
constexpr std::align_val_t cache_line{64};
}

AlignedWords AlignedWords::allocate(std::size_t count, std::shared_ptr<BlockMemory> memory) {
  AlignedWords result;
  const std::size_t bytes = count * sizeof(std::uint32_t);
  void* block =
      memory != nullptr ? memory->allocate(bytes) : ::operator new(bytes, cache_line, std::nothrow);
  if (block == nullptr) return result;
  result.words_ = {static_cast<std::uint32_t*>(block), Free{std::move(memory), bytes}};
  result.count_ = count;
  std::fill_n(result.words_.get(), count, 0u);
  return result;
}

void AlignedWords::Free::operator()(std::uint32_t* words) const {
  if (memory != nullptr) {
    memory->release(words, bytes);
  } else {
    ::operator delete(words, cache_line);
  }
}

}  // namespace nacre
