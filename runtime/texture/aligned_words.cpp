#include "runtime/texture/aligned_words.h"

#include <algorithm>
#include <new>

namespace nacre {

namespace {
constexpr std::align_val_t cache_line{64};
}

AlignedWords AlignedWords::allocate(std::size_t count) {
  AlignedWords result;
  void* memory = ::operator new(count * sizeof(std::uint32_t), cache_line, std::nothrow);
  if (!memory) return result;
  result.words_.reset(static_cast<std::uint32_t*>(memory));
  result.count_ = count;
  std::fill_n(result.words_.get(), count, 0u);
  return result;
}

void AlignedWords::Free::operator()(std::uint32_t* words) const {
  ::operator delete(words, cache_line);
}

}  // namespace nacre
