#include "examples/render/tiles.h"

#include <algorithm>

namespace nacre::host {

std::vector<Tile> make_tiles(int width, int height, int size) {
  std::vector<Tile> tiles;
  for (int y = 0; y < height; y += size) {
    for (int x = 0; x < width; x += size) {
      tiles.push_back({x, y, std::min(x + size, width), std::min(y + size, height)});
    }
  }
  return tiles;
}

TileQueue::TileQueue(std::vector<int> done, int most, int at_once)
    : done_(std::move(done)),
      is_busy_(done_.size()),
      is_finished_(done_.size()),
      most_(most),
      at_once_(at_once) {
  for (std::size_t i = 0; i < done_.size(); ++i) {
    is_finished_[i] = done_[i] >= most_;
    finished_ += is_finished_[i];
  }
}

/// Twice as many as there are, until that keeps a thread a while.
int TileQueue::next_end(int done) const {
  const int longest = 16 * at_once_;
  if (done >= longest) return std::min((done / longest + 1) * longest, most_);
  int end = at_once_;
  while (end <= done) end *= 2;
  return std::min(end, most_);
}

bool TileQueue::is_end(int done) const { return done > 0 && next_end(done - 1) == done; }

void TileQueue::finish(std::size_t tile) {
  const std::lock_guard lock(mutex_);
  if (is_finished_[tile]) return;
  is_finished_[tile] = true;
  ++finished_;
}

void TileQueue::wrap_up() {
  const std::lock_guard lock(mutex_);
  only_new_ = true;
}

std::optional<TileWork> TileQueue::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !is_paused_; });
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < done_.size() && !is_closed_; ++i) {
    if (is_busy_[i] || is_finished_[i] || (only_new_ && done_[i] > 0)) continue;
    if (!best || done_[i] < done_[*best]) best = i;
  }
  if (!best) return {};
  is_busy_[*best] = true;
  ++busy_;
  const int first = done_[*best];
  return TileWork{*best, first, next_end(first)};
}

void TileQueue::give_back(const TileWork& work, int done, bool is_finished,
                          const std::function<void(double)>& then) {
  const std::lock_guard lock(mutex_);
  done_[work.tile] = done;
  is_busy_[work.tile] = false;
  --busy_;
  if (is_finished || done >= most_) {
    is_finished_[work.tile] = true;
    ++finished_;
  }
  changed_.notify_all();
  if (!then) return;
  double share = 0;
  for (std::size_t i = 0; i < done_.size(); ++i) {
    share += is_finished_[i] ? 1.0 : static_cast<double>(done_[i]) / most_;
  }
  then(share / static_cast<double>(done_.size()));
}

void TileQueue::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
}

void TileQueue::pause(const std::function<void()>& work) {
  std::unique_lock lock(mutex_);
  if (is_paused_) return;  // Somebody else's.
  is_paused_ = true;
  changed_.wait(lock, [&] { return busy_ == 0; });
  work();
  is_paused_ = false;
  changed_.notify_all();
}

}  // namespace nacre::host
