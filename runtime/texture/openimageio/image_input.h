#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <optional>
#include <string>

#include "runtime/stop.h"
#include "runtime/texture/image_file.h"

/// The one place that hands files to OpenImageIO, whose headers no file outside this folder sees.
namespace nacre {

/// A reader with what it reads from.
struct GuardedInput {
  std::shared_ptr<const ImageFile> file;
  std::string bytes;  ///< What a reader sees of a file that it does not see itself.
  std::unique_ptr<OIIO::Filesystem::IOProxy> source;
  std::unique_ptr<OIIO::ImageInput> reader;

  /// Moves the reader to a part, page or level. Of formats that have one image it is not even
  /// asked for another: the one for GIF would then open the file itself.
  bool seek(int subimage, int level);

  /// The reader goes first, as it does when all of it goes.
  void close() {
    reader.reset();
    source.reset();
    bytes.clear();
    file.reset();
  }
};

/// Opens a file with the reader of its format, whatever its name, after everything that
/// the reader allocates or interprets unasked was looked at. Alpha is not multiplied in.
/// The sizes of what is opened are not checked yet: see check_header. Of a header nothing can be
/// read. Once `stop` is due
/// the reader gets no more bytes.
std::optional<Diagnostic> open_input(std::shared_ptr<const ImageFile> file,
                                     const ImageLimits& limits, ImageExtent extent,
                                     const Stop& stop, GuardedInput& input);

/// The image at hand against the limits, `channels` of it to be read, before anything is
/// allocated from its header; and that it is flat, two-dimensional and packed in a way that
/// its reader may unpack.
std::optional<Diagnostic> check_header(const OIIO::ImageSpec& spec, const ImageFile& file,
                                       int channels, const ImageLimits& limits);

}  // namespace nacre
