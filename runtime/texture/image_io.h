#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "runtime/diagnostic.h"

/// All that we ask of OpenImageIO. Its headers are included in image_io.cpp only.
namespace nacre {

struct ImageLimits {
  int max_size = 16384;                              ///< Of either side; at most 16384.
  std::uint64_t max_bytes = std::uint64_t{2} << 30;  ///< Decoded pixels of the part that is read.
  std::uint64_t max_file_bytes = std::uint64_t{2} << 30;
  /// Decoded bytes for each byte of the file: more is a header that lies. Deflate reaches
  /// 1032, LZW under 4096.
  std::uint64_t max_expansion = 8192;
};

/// Numbers of the file, as far as the choice of a texel format goes.
enum class SampleType { unsigned8, unsigned16, half, floating };

struct ImageInfo {
  int width = 0;  ///< Of the full (display) window.
  int height = 0;
  int channels = 0;       ///< That are kept: 1..4.
  int first_channel = 0;  ///< Number of the first of them in the file.
  int subimage = 0;
  SampleType samples = SampleType::unsigned8;
};

/// One image of a file, decoded row by row. Values are the file's own: integers become
/// value / largest, alpha is not multiplied in (where the format says whether it was).
///
/// `layer` names a subimage (a part of an EXR, or a number for the pages of a TIFF or
/// GIF), or else the channels "layer.*". Empty: the first subimage, its first channels.
/// A depth channel after colour channels is not taken for alpha.
class ImageReader {
 public:
  ImageReader();
  ~ImageReader();
  ImageReader(const ImageReader&) = delete;
  ImageReader& operator=(const ImageReader&) = delete;

  /// Reads the header and checks it against the limits: nothing of the image's size
  /// has been allocated by then.
  std::optional<Diagnostic> open(const std::string& path, const std::string& layer,
                                 const ImageLimits& limits);
  const ImageInfo& info() const { return info_; }

  /// Calls `row(y, samples)` for the full window's rows, y = 0 the TOP one, in order,
  /// with width * channels floats; pixels outside the data window are zero.
  std::optional<Diagnostic> read(const std::function<void(int, const float*)>& row);

 private:
  struct Open;
  std::optional<Diagnostic> take_png(Open& opened, std::uint64_t file_bytes) const;

  std::unique_ptr<Open> open_;
  std::string path_;
  ImageInfo info_;
};

/// Tiles of images too large to be resident, kept by OpenImageIO's ImageCache within a
/// budget. Thread-safe. Coarser levels are the file's own, or made on demand by the cache.
class TileCache {
 public:
  /// A file of the cache; valid while the cache lives.
  struct File;

  explicit TileCache(std::uint64_t budget_bytes);
  ~TileCache();
  TileCache(const TileCache&) = delete;
  TileCache& operator=(const TileCache&) = delete;

  /// Null when the cache cannot open the file. `info` as an ImageReader gave it.
  std::shared_ptr<File> open(const std::string& path, const ImageInfo& info);

  static int level_count(const File& file);
  static int width(const File& file, int level);
  static int height(const File& file, int level);

  /// Pixels [x0, x1) x [y0, y1) of a level into `samples`, channels together, y from the
  /// TOP; the range lies inside the level. False: the file could not be read there.
  bool read(const File& file, int level, int x0, int x1, int y0, int y1, float* samples) const;

 private:
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

}  // namespace nacre
