#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "runtime/diagnostic.h"

namespace nacre {

/// The readers we let image files reach. OpenImageIO has about thirty; each is an
/// attack surface, and left to itself it tries all of them on an unknown file.
enum class ImageFormat { exr, png, jpeg, tiff, hdr, tga, bmp, gif };

/// OpenImageIO's name of the reader.
std::string_view reader_name(ImageFormat format);

/// Decides by the first bytes; only TGA, which has no signature, by the extension.
/// So a JPEG called .png reads, and a text called .png is refused. `.tx` is TIFF.
std::optional<ImageFormat> recognise_image(std::span<const unsigned char> first_bytes,
                                           std::string_view path);

/// Opens the file for its first bytes. An error names the file: it does not exist, is
/// not a regular file, cannot be read, is empty, or is of no format in the list.
std::optional<ImageFormat> probe_image(const std::string& path, Diagnostic& error);

/// An error about an image file, as every function of this folder reports it.
Diagnostic image_error(std::string code, const std::string& path, std::string message,
                       std::string expected = {}, std::string found = {});

}  // namespace nacre
