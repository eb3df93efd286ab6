#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/diagnostic.h"
#include "runtime/module.h"
#include "runtime/texture/image_io.h"

namespace nacre::host {

/// Files that are written. A .tx is a TIFF in tiles, with levels of half the size each.
enum class ImageKind { exr, png, tx };

/// What the file is to be.
struct ImageHeader {
  ImageKind kind = ImageKind::exr;
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;           ///< Their names.
  SampleType samples = SampleType::unsigned8;  ///< As the file has them.
  std::string colorspace;                      ///< As OpenImageIO calls it.
  bool is_multiplied = false;                  ///< By the fourth channel, alpha.
  bool repeats = true;                         ///< Of a .tx.
};

/// An image on its way into a file.
class ImageWriter {
 public:
  virtual ~ImageWriter() = default;

  /// Rows [first, first + rows), counted from the top, which come in order: channels side by
  /// side. Integers are value * largest. False: see problem().
  virtual bool write(int first, int rows, const float* samples) = 0;
  /// After all rows. "", or what went wrong first.
  virtual std::string finish() = 0;
  /// What went wrong; not "".
  virtual std::string problem() const = 0;
};

/// The module nacre_image_writer: what needs OpenImageIO.
struct ImageWriterModule : ModuleHead {
  /// Null, with the problem, if there can be no such file.
  std::unique_ptr<ImageWriter> (*open)(const std::string& file, const ImageHeader& header,
                                       std::string& problem);
};

/// As that does; the first one loads OpenImageIO.
std::unique_ptr<ImageWriter> open_image(const std::string& file, const ImageHeader& header,
                                        std::string& problem);

/// As prepare_output (atomic_file.h) for an image: false, with an error, also where this
/// program writes none.
bool prepare_image(const std::string& path, Diagnostics& diagnostics);

}  // namespace nacre::host
