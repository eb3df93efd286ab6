#pragma once

#include <optional>
#include <string>

#include "runtime/diagnostic.h"
#include "runtime/texture/image_file.h"

namespace nacre {

// What a file's pixels need and nothing else, so that no reader sees profiles, comments,
// thumbnails and what else is interpreted with less care than pixels are. Sizes are held
// against the limits before the file is read, so `bytes`, which gets the rest of it, is
// never much larger than the pixels. A problem is returned for what is damaged or too large.

/// PNG: the chunks IHDR, PLTE, tRNS, IDAT, IEND, in order, with every checksum right (PNG
/// Specification, Third Edition, 5). libpng writes its complaints to stderr, which a
/// library must not: damaged files are sorted out before it sees them.
std::optional<Diagnostic> essential_png(const ImageFile& file, const ImageLimits& limits,
                                        std::string& bytes);

/// JPEG: all segments but comments and application data, of which JFIF's and Adobe's say
/// what the colours are (ITU-T T.81, annex B). libjpeg fills in what is missing of a file
/// that was cut; here that is an error. So are more scans than any encoder writes: each
/// costs as much as the whole image, and a few hundred bytes.
std::optional<Diagnostic> essential_jpeg(const ImageFile& file, const ImageLimits& limits,
                                         std::string& bytes);

/// TGA: header, identification and pixels, without the areas of version 2.0.
std::optional<Diagnostic> essential_tga(const ImageFile& file, const ImageLimits& limits,
                                        std::string& bytes);

/// A size outside the limits, as all readers say it; nothing for one inside.
std::optional<Diagnostic> check_image_size(const std::string& path, std::int64_t width,
                                           std::int64_t height, const ImageLimits& limits);

}  // namespace nacre
