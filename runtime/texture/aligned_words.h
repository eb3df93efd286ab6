#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "runtime/block_memory.h"

namespace nacre {

/// A fixed-size array of zeroed 32-bit words on a 64-byte boundary.
class AlignedWords {
 public:
  AlignedWords() = default;

  /// Empty when the memory cannot be had: textures are large enough for that to be
  /// an event to report rather than an exception. `memory` null: the process's own.
  static AlignedWords allocate(std::size_t count, std::shared_ptr<BlockMemory> memory = nullptr);

  /// No words: none were asked for, or none could be had.
  bool empty() const { return count_ == 0; }
  /// All words; valid while this lives.
  /// @{
  std::span<std::uint32_t> span() { return {words_.get(), count_}; }
  std::span<const std::uint32_t> span() const { return {words_.get(), count_}; }
  /// @}

 private:
  struct Free {
    std::shared_ptr<BlockMemory> memory;  ///< Null: the process's own.
    std::size_t bytes;
    void operator()(std::uint32_t* words) const;
  };
  std::unique_ptr<std::uint32_t[], Free> words_{nullptr, Free{nullptr, 0}};
  std::size_t count_ = 0;
};

}  // namespace nacre
