#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "runtime/module.h"
#include "runtime/texture/image_file.h"
#include "runtime/texture/image_io.h"
#include "runtime/texture/tile_cache.h"

namespace nacre {

/// What an ImageReader reads with.
class ImageDecoder {
 public:
  virtual ~ImageDecoder() = default;

  /// See ImageReader::open and, of a header, look; fills in `info`. May throw, and so may `read`.
  virtual std::optional<Diagnostic> open(std::shared_ptr<const ImageFile> file,
                                         const std::string& layer, const ImageLimits& limits,
                                         ImageExtent extent, const Stop& stop, ImageInfo& info) = 0;
  /// See ImageReader::read; of what was opened whole.
  virtual std::optional<Diagnostic> read(const std::function<void(int, const float*)>& row) = 0;
};

/// The module nacre_images: all that needs OpenImageIO.
struct ImageModule : ModuleHead {
  std::unique_ptr<ImageDecoder> (*make_decoder)();
  /// See TileCache::make.
  std::shared_ptr<TileCache> (*make_tile_cache)(std::uint64_t budget_bytes,
                                                const ImageLimits& limits);
};

/// Null, with an error about the image that is not read for it, if there is none.
const ImageModule* image_module(const std::string& path, Diagnostic& error);

}  // namespace nacre
