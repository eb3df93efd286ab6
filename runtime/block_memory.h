#pragma once

#include <cstddef>

namespace nacre {

/// Where large blocks come from, the texels of resident images; a host may have its own. Members
/// may be called by any thread.
class BlockMemory {
 public:
  virtual ~BlockMemory() = default;
  /// At least `bytes`, on a boundary of 64; null where there is no memory.
  virtual void* allocate(std::size_t bytes) noexcept = 0;
  /// Of a block that allocate() gave, with its size.
  virtual void release(void* block, std::size_t bytes) noexcept = 0;
};

}  // namespace nacre
