#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/diagnostic.h"
#include "runtime/texture/image_file.h"

namespace nacre {

// What a file's pixels need and nothing else, so that no reader sees profiles, comments,
// thumbnails and what else is interpreted with less care than pixels are. Sizes are held
// against the limits before the file is read, so `bytes`, which gets the rest of it, is
// never much larger than the pixels. A problem is returned for what is damaged or too large.
// Of the header alone a reader can be opened, and nothing be read; what follows it is not looked
// at.

/// PNG: the chunks IHDR, PLTE, tRNS, IDAT, IEND, in order, with every checksum right (PNG
/// Specification, Third Edition, 5), and pixels that can be unpacked. libpng writes its
/// complaints to stderr, which a library must not: damaged files are sorted out before it
/// sees them.
std::optional<Diagnostic> essential_png(const ImageFile& file, const ImageLimits& limits,
                                        ImageExtent extent, std::string& bytes);

/// JPEG: all segments but comments and application data, of which JFIF's and Adobe's say
/// what the colours are (ITU-T T.81, annex B). libjpeg fills in what is missing of a file
/// that was cut; here that is an error. So are more scans than any encoder writes: each
/// costs as much as the whole image, and a few hundred bytes.
std::optional<Diagnostic> essential_jpeg(const ImageFile& file, const ImageLimits& limits,
                                         ImageExtent extent, std::string& bytes);

/// TGA: header, identification and pixels, without the areas of version 2.0.
std::optional<Diagnostic> essential_tga(const ImageFile& file, const ImageLimits& limits,
                                        ImageExtent extent, std::string& bytes);

/// GIF: the first image alone, for a texture does not move; its colours, its transparency
/// and its codes, in canonical form (GIF89a Specification). Comments, applications' blocks
/// and further frames are left out, and what follows the image is not looked at. Always whole, for
/// its reader unpacks the image while it is opened.
std::optional<Diagnostic> essential_gif(const ImageFile& file, const ImageLimits& limits,
                                        ImageExtent extent, std::string& bytes);

/// BMP: size, depth, masks, palette and pixels behind a header of Windows' third version,
/// whatever the file has (Microsoft, "Bitmap Storage"); runs are written out. Of 32 bits
/// the fourth byte is alpha, even where the documentation says that it is nothing.
std::optional<Diagnostic> essential_bmp(const ImageFile& file, const ImageLimits& limits,
                                        ImageExtent extent, std::string& bytes);

/// A size outside the limits, as all readers say it; nothing for one inside.
std::optional<Diagnostic> check_image_size(const std::string& path, std::int64_t width,
                                           std::int64_t height, const ImageLimits& limits);

/// Bytes that the pixels of an image take.
struct PixelBytes {
  std::uint64_t decoded = 0;    ///< Unpacked in the reader or of what is kept, whichever is more.
  std::uint64_t kept = 0;       ///< Of the pixels that the file has, of channels that are read.
  std::uint64_t in_memory = 0;  ///< As texels.
};

/// What the pixels take against the limits and what the file has.
std::optional<Diagnostic> check_image_bytes(const ImageFile& file, const PixelBytes& bytes,
                                            const ImageLimits& limits);

}  // namespace nacre
