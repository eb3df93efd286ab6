#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/texture/image_io.h"

namespace nacre {

/// Tiles of images too large to be resident, kept by OpenImageIO's ImageCache within a
/// budget. Thread-safe. Coarser levels are the file's own, or made on demand by the cache.
/// Files go through the same guard as an ImageReader's, whenever the cache opens them.
class TileCache {
 public:
  /// A file of the cache; valid while the cache lives.
  struct File {
    /// Sizes of the full window.
    struct Level {
      int width = 0;
      int height = 0;
    };
    std::vector<Level> levels;  ///< At least one, the finest first.
  };

  /// Tiles of all files together stay within the budget. Null where images cannot be read.
  static std::shared_ptr<TileCache> make(std::uint64_t budget_bytes, const ImageLimits& limits);
  TileCache() = default;
  virtual ~TileCache() = default;
  TileCache(const TileCache&) = delete;
  TileCache& operator=(const TileCache&) = delete;

  /// Null when the cache cannot open the file. `info` as an ImageReader gave it. Tiles are
  /// of that file alone: once another has its name, or it was written again, what is not in
  /// the cache yet cannot be read any more.
  virtual std::shared_ptr<File> open(const std::string& path, const ImageInfo& info) = 0;

  /// At least 1.
  static int level_count(const File& file) { return static_cast<int>(file.levels.size()); }
  /// Of the full window, at a level less than level_count().
  static int width(const File& file, int level) {
    return file.levels[static_cast<std::size_t>(level)].width;
  }
  /// Of the full window, at a level less than level_count().
  static int height(const File& file, int level) {
    return file.levels[static_cast<std::size_t>(level)].height;
  }

  /// Pixels [x0, x1) x [y0, y1) of a level into `samples`, channels together, y from the
  /// TOP; the range lies inside the level. False: the file could not be read there.
  virtual bool read(const File& file, int level, int x0, int x1, int y0, int y1,
                    float* samples) const = 0;

  /// How often `read` gave false.
  virtual std::uint64_t read_failures() const = 0;
};

}  // namespace nacre
