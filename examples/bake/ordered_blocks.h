#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>

namespace nacre::host {

/// Hands out the numbers of blocks to threads, and does what is left of each block in order: a
/// thread that is ahead of others waits, so that few blocks are kept at once.
class OrderedBlocks {
 public:
  /// Blocks 0 to count - 1, `window` of them begun and not done at most. Nothing goes on once
  /// `ends` is not 0.
  OrderedBlocks(int count, int window, std::atomic<std::uint32_t>& ends)
      : count_(count), window_(window), ends_(ends) {}

  /// The next block; nothing where there are no more.
  std::optional<int> begin();
  /// Calls `rest` of this block, and of those after it that waited for it, unless a thread is at
  /// it. Where it returns false, or throws, `ends` is 1. True if all of them returned true.
  bool finish(int block, std::function<bool()> rest);
  /// Lets those go that wait: `ends` was set.
  void wake();

  /// Whether all blocks were begun.
  bool is_begun() const { return next_ >= count_; }

 private:
  const int count_;
  const int window_;
  std::atomic<std::uint32_t>& ends_;
  std::mutex mutex_;
  std::condition_variable moved_;
  std::atomic<int> next_ = 0;
  int done_ = 0;
  bool is_finishing_ = false;
  std::map<int, std::function<bool()>> waiting_;
};

}  // namespace nacre::host
