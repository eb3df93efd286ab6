#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "runtime/diagnostic.h"
#include "runtime/module.h"
#include "runtime/texture/image_io.h"

namespace nacre::host {

/// Files that are written. A .tx is a TIFF in tiles, with levels of half the size each.
enum class ImageKind { exr, png, tx };

/// Of SampleType::half: what is larger and finite is stored as that.
inline constexpr float largest_half = 65504.0f;

/// What the file is to be.
struct ImageHeader {
  ImageKind kind = ImageKind::exr;
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;           ///< Their names.
  SampleType samples = SampleType::unsigned8;  ///< As the file has them.
  std::string colorspace;                      ///< As OpenImageIO calls it; "": not said.
  /// Of integers: all but a fourth channel get the codes of sRGB for linear values.
  bool codes_srgb = false;
  bool repeats = true;  ///< Beyond its edges the image is there again, else its edge.
  /// Where it lies in a larger image, of which it is all that there is; of an .exr.
  struct Display {
    int x = 0, y = 0, width = 0, height = 0;
  };
  std::optional<Display> display = std::nullopt;
  /// x and y of red, green, blue and white, where they are known; of an .exr.
  std::optional<std::array<float, 8>> chromaticities = std::nullopt;
  /// Further attributes, by the names that OpenImageIO has for them.
  std::vector<std::pair<std::string, std::string>> texts = {};
};

/// Rows on their way into a file: `planes` has a plane of width * rows floats for each channel.
struct ImageRows {
  int first = 0;  ///< Counted from the top.
  int rows = 0;
  std::span<const std::vector<float>> planes;
};

/// Rows as the file has them, or nearly.
struct EncodedRows {
  int first = 0;
  int rows = 0;
  std::vector<unsigned char> bytes;
  std::uint32_t checksum = 0;
  std::uint64_t raw_bytes = 0;  ///< That the checksum is of.
};

/// An image on its way into a file, by blocks of rows: what takes time, `encode`, any threads
/// may do for several blocks at once. The file's bytes are the same whoever did.
class ImageWriter {
 public:
  virtual ~ImageWriter() = default;

  /// The rows of a block; the last one may have fewer.
  virtual int block_rows() const = 0;
  /// Of one block. Integers are value * largest, rounded.
  virtual EncodedRows encode(const ImageRows& rows) const = 0;
  /// Blocks in order, from the top. False: see problem().
  virtual bool append(const EncodedRows& rows) = 0;
  /// After all rows. "", or what went wrong first.
  virtual std::string finish() = 0;
  /// What went wrong; not "".
  virtual std::string problem() const = 0;
};

/// Writes a whole image. "", or what went wrong first.
std::string write_planes(ImageWriter& image, const ImageHeader& header,
                         std::span<const std::vector<float>> planes);

/// The module nacre_image_writer: what needs OpenImageIO, so .tx.
struct ImageWriterModule : ModuleHead {
  /// Null, with the problem, if there can be no such file.
  std::unique_ptr<ImageWriter> (*open)(const std::string& file, const ImageHeader& header,
                                       std::string& problem);
};

/// As that does, for all kinds; the first .tx loads OpenImageIO.
std::unique_ptr<ImageWriter> open_image(const std::string& file, const ImageHeader& header,
                                        std::string& problem);

/// As prepare_output (atomic_file.h) for an image: false, with an error, also where this
/// program writes none of that kind, by its extension.
bool prepare_image(const std::string& path, Diagnostics& diagnostics);

}  // namespace nacre::host
