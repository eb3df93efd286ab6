#include "examples/render/tiles.h"

#include <algorithm>
#include <utility>

namespace nacre::host {

std::vector<Tile> make_tiles(int width, int height, int size, const PixelWindow& window) {
  std::vector<Tile> tiles;
  for (int y = window.y0 / size * size; y < window.y1; y += size) {
    for (int x = window.x0 / size * size; x < window.x1; x += size) {
      tiles.push_back({x, y, std::min(x + size, width), std::min(y + size, height)});
    }
  }
  return tiles;
}

std::vector<Tile> cut_tiles(std::vector<Tile> tiles, const PixelWindow& window) {
  for (Tile& tile : tiles) tile = both(tile, window);
  return tiles;
}

PixelWindow window_of(const std::vector<Tile>& tiles) {
  return {tiles.front().x0, tiles.front().y0, tiles.back().x1, tiles.back().y1};
}

TileQueue::TileQueue(std::vector<int> done, int most, int at_once)
    : done_(std::move(done)), most_(most), at_once_(at_once) {
  for (std::size_t i = 0; i < done_.size(); ++i) {
    samples_ += done_[i];
    if (done_[i] < most_) {
      ready_.emplace(done_[i], i);
    } else {
      count_finished(i);
    }
  }
}

void TileQueue::count_finished(std::size_t tile) {
  ++finished_;
  samples_ += most_ - done_[tile];
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
  if (ready_.erase({done_[tile], tile}) > 0) count_finished(tile);
}

void TileQueue::wrap_up() {
  const std::lock_guard lock(mutex_);
  only_new_ = true;
}

std::optional<TileWork> TileQueue::take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return !is_paused_; });
  if (ready_.empty() || is_closed_) return {};
  const auto [first, tile] = *ready_.begin();
  if (only_new_ && first > 0) return {};
  ready_.erase(ready_.begin());
  ++busy_;
  return TileWork{tile, first, next_end(first)};
}

void TileQueue::give_back(const TileWork& work, int done, bool is_finished,
                          const std::function<void(double)>& then) {
  const std::lock_guard lock(mutex_);
  samples_ += done - done_[work.tile];
  done_[work.tile] = done;
  --busy_;
  if (is_finished || done >= most_) {
    count_finished(work.tile);
  } else {
    ready_.emplace(done, work.tile);
  }
  changed_.notify_all();
  if (then) then(samples_ / most_ / static_cast<double>(done_.size()));
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
