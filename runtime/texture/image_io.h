#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "runtime/diagnostic.h"
#include "runtime/stop.h"
#include "runtime/texture/file_identity.h"
#include "runtime/texture/image_format.h"
#include "runtime/texture/image_limits.h"

namespace nacre {

class ImageDecoder;

/// Numbers of the file, as far as the choice of a texel format goes.
enum class SampleType { unsigned8, unsigned16, half, floating };

/// What the header of a file says of an image.
struct ImageInfo {
  int width = 0;                               ///< Of the full (display) window.
  int height = 0;                              ///< Of the full (display) window.
  int channels = 0;                            ///< That are kept: 1..4.
  int first_channel = 0;                       ///< Number of the first of them in the file.
  int subimage = 0;                            ///< Number of the part or page in the file.
  SampleType samples = SampleType::unsigned8;  ///< As the file has them.
  FileIdentity file;                           ///< What was opened.
};

/// One image of a file, decoded row by row: the only reader of images there is, for
/// textures, environments and whatever else. The first one that is no JPEG loads OpenImageIO.
/// Values are the file's own: integers become value / largest, alpha is not multiplied in (where
/// the format says whether it was).
///
/// `layer` names a subimage (a part of an EXR, or a number for the pages of a TIFF), or
/// else the channels "layer.*". Empty: the first subimage, its first channels. A depth
/// channel after colour channels is not taken for alpha.
class ImageReader {
 public:
  ImageReader();
  ~ImageReader();
  ImageReader(const ImageReader&) = delete;
  ImageReader& operator=(const ImageReader&) = delete;

  /// Reads the header and checks it against the limits: nothing of the image's size
  /// has been allocated by then. Never throws, nor does `read`: what readers of hostile
  /// files throw is one more broken image. Once `stop` is due both end with the error
  /// "stopped".
  std::optional<Diagnostic> open(const std::string& path, const std::string& layer,
                                 const ImageLimits& limits, const Stop& stop = {});
  /// The same of the header alone: costs next to nothing, whatever the size of the image, of which
  /// nothing is unpacked or can be read afterwards. What is wrong with the pixels is not noticed.
  std::optional<Diagnostic> look(const std::string& path, const std::string& layer,
                                 const ImageLimits& limits, const Stop& stop = {});
  /// After open() or look() without an error.
  const ImageInfo& info() const { return info_; }

  /// Calls `row(y, samples)` for the full window's rows, y = 0 the TOP one, in order,
  /// with width * channels floats; pixels outside the data window are zero.
  std::optional<Diagnostic> read(const std::function<void(int, const float*)>& row);

 private:
  std::optional<Diagnostic> open(const std::string& path, const std::string& layer,
                                 const ImageLimits& limits, const Stop& stop, ImageExtent extent);
  std::optional<Diagnostic> open_image(const std::string& layer, const ImageLimits& limits,
                                       ImageExtent extent);
  std::optional<Diagnostic> guarded(const std::function<std::optional<Diagnostic>()>& work);

  std::unique_ptr<ImageDecoder> decoder_;
  std::string path_;
  ImageInfo info_;
  Stop stop_;
};

}  // namespace nacre
