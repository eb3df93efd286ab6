#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "examples/render/pixel_window.h"

namespace nacre::host {

/// Pixels that are rendered together.
using Tile = PixelWindow;

/// Those of an image that a window has some pixels of, rows from the top: squares from its upper
/// left corner on, whatever the window, cut off at the image's edges.
std::vector<Tile> make_tiles(int width, int height, int size, const PixelWindow& window);

/// What the window has of each of them.
std::vector<Tile> cut_tiles(std::vector<Tile> tiles, const PixelWindow& window);

/// The window that such tiles make together.
PixelWindow window_of(const std::vector<Tile>& tiles);

/// Samples of a tile's pixels that are to be added.
struct TileWork {
  std::size_t tile = 0;
  int first = 0, last = 0;  ///< Samples.
};

/// Hands tiles to threads, those with the fewest samples first, so that the image is there at once
/// and gets better. What a tile gets depends on its own samples alone.
class TileQueue {
 public:
  /// `done`: samples that each tile has, all `most` of those that are finished. `at_once`: as many
  /// as take a thread a moment.
  TileQueue(std::vector<int> done, int most, int at_once);

  /// What a thread is to do next; nothing where all is done or handed out. Waits while pause()
  /// does.
  std::optional<TileWork> take();
  /// Work that was taken is done up to a sample, or to its end and the tile is finished. Calls
  /// `then` with the finished share of all, one thread at a time.
  void give_back(const TileWork& work, int done, bool is_finished,
                 const std::function<void(double)>& then);
  /// A tile that is good enough already.
  void finish(std::size_t tile);
  /// Hands out tiles without a sample only,
  void wrap_up();
  /// or nothing any more.
  void close();
  /// Calls `work` while no tile is being worked on. Only without work that was taken.
  void pause(const std::function<void()>& work);

  /// By tile.
  const std::vector<int>& done() const { return done_; }
  /// Whether all tiles are.
  bool is_finished() const { return finished_ == done_.size(); }
  /// Whether work that ends with so many samples is whole: the same numbers for every tile, and
  /// wherever a render was interrupted.
  bool is_end(int done) const;

 private:
  int next_end(int done) const;
  void count_finished(std::size_t tile);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<int> done_;
  std::set<std::pair<int, std::size_t>> ready_;  ///< Samples and tile, of those nobody works on.
  int most_, at_once_;
  std::size_t busy_ = 0, finished_ = 0;
  double samples_ = 0;  ///< Of all tiles, those that are finished counting in full.
  bool is_closed_ = false, only_new_ = false, is_paused_ = false;
};

}  // namespace nacre::host
