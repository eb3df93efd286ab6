#include "examples/bake/ordered_blocks.h"

namespace nacre::host {

std::optional<int> OrderedBlocks::begin() {
  std::unique_lock lock(mutex_);
  moved_.wait(lock, [&] { return next_ >= count_ || next_ < done_ + window_ || ends_ != 0; });
  if (ends_ != 0 || next_ >= count_) return std::nullopt;
  return next_++;
}

bool OrderedBlocks::finish(int block, std::function<bool()> rest) {
  std::unique_lock lock(mutex_);
  waiting_.emplace(block, std::move(rest));
  if (is_finishing_) return true;
  is_finishing_ = true;
  bool is_right = true;
  while (!waiting_.empty() && waiting_.begin()->first == done_ && ends_ == 0) {
    const std::function<bool()> work = std::move(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
    lock.unlock();
    try {
      is_right = work();
    } catch (...) {
      ends_ = 1;
      wake();
      throw;
    }
    lock.lock();
    if (!is_right) ends_ = 1;
    ++done_;
    moved_.notify_all();
  }
  is_finishing_ = false;
  return is_right;
}

void OrderedBlocks::wake() {
  {
    const std::lock_guard guard(mutex_);
  }  // Whoever looked at `ends` before it was set waits now.
  moved_.notify_all();
}

}  // namespace nacre::host
